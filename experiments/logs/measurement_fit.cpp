#include "experiments/logs/measurement_fit.hpp"

#include <cmath>
#include <deque>
#include <functional>
#include <iterator>

#include <fmt/format.h>

#include "core/error.hpp"
#include "estimator/bayes/measurement_fit.hpp"
#include "experiments/logs/listener.hpp"
#include "experiments/signals/reserved_seeds.hpp"
#include "scoring/label_stream.hpp"

namespace touchdown::experiments {

namespace {

using Sink = std::function<void(bool contact, const TorqueSample& sample)>;

bool finite(const LegSignals& leg) {
  return std::isfinite(leg.knee.torque) && std::isfinite(leg.wheel.torque);
}

/// Samples of one leg on their way to the fit: they wait for their labels.
class Leg {
 public:
  Leg(const TorqueConfig& config, Side side, const LogListener& log,
      const scoring::LabelConfig& labels, Sink sink)
      : channel_(config, side, log.sample_rate()),
        sink_(std::move(sink)),
        labels_(log.period(), labels, [this](std::uint8_t contact) { label(contact != 0); }) {}
  Leg(const Leg&) = delete;
  Leg& operator=(const Leg&) = delete;

  void restart() { channel_.reset(); }

  /// `force` tells the label later, `declared` at once. Returns whether the torques could be used.
  bool add(const LegSignals& leg, bool skipped, std::optional<bool> declared, double force) {
    std::optional<TorqueSample> sample;
    const bool usable = finite(leg);
    if (usable) sample = channel_.update(leg);
    if (skipped) sample.reset();
    if (declared) {
      if (sample) sink_(*declared, *sample);
    } else {
      waiting_.push_back(sample);
      labels_.add(force);
    }
    return usable;
  }

  void finish() { labels_.finish(); }

 private:
  void label(bool contact) {
    if (waiting_.front()) sink_(contact, *waiting_.front());
    waiting_.pop_front();
  }

  TorqueChannel channel_;
  Sink sink_;
  std::deque<std::optional<TorqueSample>> waiting_;
  scoring::LabelStream labels_;
};

bool is_gap(double elapsed, const SignalGuardConfig& guard) {
  return !(elapsed >= 0.0 && elapsed <= guard.maximum_gap);
}

void read_log(const FitLog& log, const BayesFilterConfig& filter, const LogFitConfig& config,
              const Sink& sink, LogFitReport& report) {
  recordings::LogReader reader(log.path, config.stop);
  LogListener listener(reader);
  check_may_be_fitted(reader.info());
  const TorqueConfig& torque = filter.measurement.torque;
  std::array<Leg, models::wheel_count> legs = {
      Leg(torque, Side::left, listener, config.labels, sink),
      Leg(torque, Side::right, listener, config.labels, sink)};
  const auto skipped = std::llround(config.skip / listener.period());
  double before = NAN;
  std::int64_t k = 0;
  for (; const LogStep* step = listener.next(); ++k) {
    if (!log.contact && !step->normal_force) {
      throw InputError(
          fmt::format("{}: at {:.3f} s: no ground truth of contact: name the log after --contact "
                      "or --no-contact if all of it is one of them",
                      log.path.string(), step->signals.time));
    }
    for (std::size_t side = 0; side < legs.size(); ++side) {
      if (k > 0 && is_gap(step->signals.time - before, filter.guard)) legs[side].restart();
      const double force = log.contact ? 0.0 : (*step->normal_force)[side];
      if (!legs[side].add(step->signals.leg[side], k < skipped, log.contact, force)) {
        ++report.unusable;
      }
    }
    before = step->signals.time;
  }
  if (config.stop != nullptr && *config.stop) throw Stopped("stopped; no model was written");
  for (Leg& leg : legs) leg.finish();
  report.seconds += static_cast<double>(std::max<std::int64_t>(k - skipped, 0)) * listener.period();
  report.warnings.insert(report.warnings.end(), reader.warnings().begin(), reader.warnings().end());
}

void require_both_classes(const MeasurementFit& fit) {
  if (fit.count(false) < 2) {
    throw InputError(
        "fit: no step of the logs is without contact: add a log with flights, or one of a robot "
        "that hangs after --no-contact");
  }
  if (fit.count(true) < 2) {
    throw InputError(
        "fit: no step of the logs is in contact: add a log of a robot that rolls, after --contact "
        "if it has no ground truth");
  }
}

}  // namespace

MeasurementModel fit_measurement_to_logs(std::span<const FitLog> logs,
                                         const BayesFilterConfig& filter,
                                         const LogFitConfig& config, LogFitReport& report) {
  MeasurementFit fit(filter.measurement.fit);
  report = {};
  for (const FitLog& log : logs) {
    if (log.path == "-") throw InputError("fit: reads a log twice: '-' cannot be read again");
    read_log(
        log, filter, config,
        [&](bool contact, const TorqueSample& sample) { fit.survey(contact, sample); }, report);
  }
  require_both_classes(fit);
  fit.prepare();
  LogFitReport again;
  for (const FitLog& log : logs) {
    read_log(
        log, filter, config,
        [&](bool contact, const TorqueSample& sample) { fit.add(contact, sample); }, again);
  }
  for (const bool contact : {false, true}) {
    report.samples[contact ? 1 : 0] = fit.count(contact);
    report.bandwidth[contact ? 1 : 0] = fit.bandwidth(contact);
  }
  return fit.model();
}

}  // namespace touchdown::experiments
