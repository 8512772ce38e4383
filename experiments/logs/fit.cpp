#include "experiments/logs/fit.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/stop.hpp"
#include "estimator/bayes/measurement_fit.hpp"
#include "estimator/signal_guard.hpp"
#include "scoring/labels.hpp"

namespace touchdown::experiments {

namespace {

using Sink = std::function<void(bool contact, const TorqueSample& sample)>;

/// Buffers the samples of one leg until their labels are known, then passes them to the fit.
class LabelledLeg {
 public:
  LabelledLeg(const TorqueConfig& config, Side side, const FitLogSteps& log,
              const scoring::LabelConfig& labels, Sink sink)
      : channel_(config, side, log.steps().sample_rate()),
        sink_(std::move(sink)),
        labels_(log.steps().period(), log.robot_mass(), labels,
                [this](std::uint8_t contact) { label(contact != 0); }) {}
  LabelledLeg(const LabelledLeg&) = delete;
  LabelledLeg& operator=(const LabelledLeg&) = delete;

  void restart() { channel_.reset(); }

  /// `declared` labels the sample at once, `force` (N) once that of later steps decides. Returns
  /// whether the torques are usable.
  bool add(const LegSignals& leg, bool skipped, std::optional<bool> declared, double force) {
    std::optional<TorqueSample> sample;
    const bool usable = has_torques(leg);
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

void read_log(const FitLog& log, const MeasurementConfig& measurement, const LogFitConfig& config,
              const Sink& sink, LogFitReport& report) {
  FitLogSteps reader(log, config, report);
  const LogSteps& steps = reader.steps();
  const TorqueConfig& torque = measurement.torque;
  std::array<LabelledLeg, models::wheel_count> legs = {
      LabelledLeg(torque, Side::left, reader, config.labels, sink),
      LabelledLeg(torque, Side::right, reader, config.labels, sink)};
  const auto skipped = std::llround(config.skip / steps.period());
  double before = NAN;
  std::int64_t k = 0;
  std::int64_t used = 0;
  for (; const LogStep* step = reader.next(); ++k) {
    reader.require_truth();
    const bool is_used = k >= skipped && reader.is_covered();
    if (is_used) ++used;
    for (std::size_t side = 0; side < legs.size(); ++side) {
      if (k > 0 && is_gap(step->signals.time - before, SignalGuardConfig{})) legs[side].restart();
      const double force = step->normal_force ? (*step->normal_force)[side] : 0.0;
      const std::optional<bool> contact = log.labels ? std::optional(force > 0.0) : log.contact;
      if (!legs[side].add(step->signals.leg[side], !is_used, contact, force)) {
        ++report.unusable;
      }
    }
    before = step->signals.time;
  }
  reader.finish(used);
  for (LabelledLeg& leg : legs) leg.finish();
  report.fitted_to.seconds += static_cast<double>(used) * steps.period();
}

/// Errors: `InputError` without samples of one class; index 0 is no contact, 1 is contact.
void require_both_classes(const std::array<std::vector<TorqueSample>, 2>& samples) {
  for (const std::size_t of_class : {0U, 1U}) {
    if (samples[of_class].size() >= 2) continue;
    throw InputError(fmt::format(
        "fit: no step of the logs is {}: add a log {}",
        of_class == 0 ? "without contact" : "in contact",
        of_class == 0 ? "with flights, or one of a robot that hangs after --no-contact"
                      : "of a robot that rolls, after --contact if it has no ground truth"));
  }
}

MeasurementModel fit_measurement_to_logs(std::span<const FitLog> logs,
                                         const MeasurementConfig& measurement,
                                         const LogFitConfig& config, LogFitReport& report) {
  std::array<std::vector<TorqueSample>, 2> samples;
  report = {};
  for (const FitLog& log : logs) {
    end_if(config.stop);
    read_log(
        log, measurement, config,
        [&](bool contact, const TorqueSample& sample) {
          samples[contact ? 1 : 0].push_back(sample);
        },
        report);
  }
  require_both_classes(samples);
  MeasurementFit fit = fit_measurement(samples[1], samples[0], measurement.fit);
  end_if(config.stop);
  report.samples = {samples[0].size(), samples[1].size()};
  report.bandwidth = fit.bandwidth;
  return std::move(fit.model);
}

}  // namespace

Model fit_to_logs(const EstimatorEntry& entry, std::span<const FitLog> logs,
                  const LogFitConfig& config, LogFitReport& report) {
  check_names(config.hyperparameters, entry);
  const EstimatorEntry chosen = with_hyperparameters(entry, config.hyperparameters);
  Model model{.grid = fit_measurement_to_logs(logs, *chosen.fitting.torques, config, report)};
  const auto& [without, with] = report.declared_load;
  if (with.sum * without.count < without.sum * with.count) {
    report.warnings.push_back(fmt::format(
        "the torques give a wheel {:.0f} N in the logs after --contact and {:.0f} N in those after "
        "--no-contact: are they exchanged?",
        with.sum / with.count, without.sum / without.count));
  }
  FittedTo& fitted_to = report.fitted_to;
  for (const auto& [digest, name] : report.digests) fitted_to.logs.insert(digest);
  if (!config.robot.name.empty()) fitted_to.robots = {config.robot.name};
  describe_fit(entry.name, fitted_to, config.hyperparameters, model);
  return model;
}

}  // namespace touchdown::experiments
