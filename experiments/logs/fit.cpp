#include "experiments/logs/fit.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "core/stop.hpp"
#include "estimator/bayes/measurement_fit.hpp"
#include "estimator/signal_guard.hpp"
#include "experiments/signals/run_signals.hpp"
#include "scoring/labels.hpp"

namespace touchdown::experiments {

namespace {

using Sink = std::function<void(bool contact, const TorqueSample& sample)>;

/// Buffers the samples of one leg until their labels are known, then passes them to the fit.
class LabelledLeg {
 public:
  LabelledLeg(const TorqueConfig& config, Side side, const LogSteps& log,
              const scoring::LabelConfig& labels, Sink sink)
      : channel_(config, side, log.sample_rate()),
        sink_(std::move(sink)),
        labels_(log.period(), labels, [this](std::uint8_t contact) { label(contact != 0); }) {}
  LabelledLeg(const LabelledLeg&) = delete;
  LabelledLeg& operator=(const LabelledLeg&) = delete;

  void restart() { channel_.reset(); }

  /// `declared` labels the sample at once, `force` (N) once the debounce has passed. Returns
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
      LabelledLeg(torque, Side::left, steps, config.labels, sink),
      LabelledLeg(torque, Side::right, steps, config.labels, sink)};
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
  report.seconds += static_cast<double>(used) * steps.period();
}

/// Samples of both legs; index 0 is no contact, 1 is contact.
using ClassCounts = std::array<std::size_t, 2>;

/// Errors: `InputError` without samples of one class. `skipped` are those at the beginning of logs.
void require_both_classes(const ClassCounts& used, const ClassCounts& skipped, double skip) {
  for (const std::size_t of_class : {0U, 1U}) {
    if (used[of_class] >= 2) continue;
    throw InputError(fmt::format(
        "fit: no step of the logs is {}{}: add a log {}",
        of_class == 0 ? "without contact" : "in contact",
        skipped[of_class] == 0
            ? std::string()
            : fmt::format(" ({} such steps lie in the first {:.4g} s of their logs, which --skip "
                          "leaves out)",
                          skipped[of_class] / models::wheel_count, skip),
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
    read_log(
        log, measurement, config,
        [&](bool contact, const TorqueSample& sample) {
          samples[contact ? 1 : 0].push_back(sample);
        },
        report);
  }
  require_both_classes({samples[0].size(), samples[1].size()}, {}, config.skip);
  MeasurementFit fit = fit_measurement(samples[1], samples[0], measurement.fit);
  report.samples = {samples[0].size(), samples[1].size()};
  report.bandwidth = fit.bandwidth;
  return std::move(fit.model);
}

/// Errors: `InputError` for a step that a filter of phases cannot be fitted to.
/// `before` is the time of the run's last one.
void check_step(const FitLog& log, const LogStep& step, double before) {
  const auto refuse = [&](std::string_view what) {
    throw InputError(
        fmt::format("{}: at {:.3f} s: {}", log.path.string(), step.signals.time, what));
  };
  if (!step.normal_force) {
    refuse("no ground truth of contact, which phase and hmm are fitted with");
  }
  if (!std::isfinite(step.signals.vertical_acceleration) || !has_torques(step.signals.leg[0]) ||
      !has_torques(step.signals.leg[1])) {
    refuse("a torque or the acceleration is not finite, or beyond what a sensor measures");
  }
  const double elapsed = step.signals.time - before;
  if (elapsed < 0.0 || elapsed > SignalGuardConfig{}.maximum_gap) {
    refuse("time jumps: phase and hmm are fitted to logs without gaps");
  }
}

void append(RunSignals& run, const LogStep& step, std::optional<bool> declared) {
  run.signals.push_back(step.signals);
  for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
    if (declared) {
      run.contact[wheel].push_back(*declared ? 1 : 0);
    } else {
      run.normal_force[wheel].push_back((*step.normal_force)[wheel]);
    }
  }
}

/// The log as one run, or as one run per labelled segment.
void add_runs_of_log(const FitLog& log, const LogFitConfig& config, bool is_for_phases,
                     LogFitReport& report, std::vector<RunSignals>& runs) {
  FitLogSteps reader(log, config, report);
  RunSignals run;
  const auto finish = [&] {
    if (run.signals.empty()) return;
    run.info = reader.info();
    run.legs = reader.legs();
    for (std::size_t wheel = 0; wheel < models::wheel_count && !log.contact; ++wheel) {
      run.contact[wheel] =
          scoring::contact_labels(run.normal_force[wheel], run.period(), config.labels);
    }
    runs.push_back(std::move(run));
    run = {};
  };
  std::int64_t used = 0;
  for (std::int64_t k = 0; const LogStep* step = reader.next(); ++k) {
    if (!reader.is_covered()) {
      finish();
      continue;
    }
    if (is_for_phases) {
      check_step(log, *step, run.signals.empty() ? NAN : run.signals.back().time);
    } else {
      reader.require_truth();
    }
    if (run.signals.empty()) run.start = static_cast<double>(k) * reader.steps().period();
    append(run, *step, log.contact);
    ++used;
  }
  finish();
  reader.finish(used);
}

/// Loads all logs into memory, and adds to the report how much of them is used. `skipped` gets the
/// samples at the beginning of logs.
std::vector<RunSignals> signals_of_logs(std::span<const FitLog> logs, const LogFitConfig& config,
                                        bool is_for_phases, LogFitReport& report,
                                        ClassCounts& skipped_samples) {
  report = {};
  skipped_samples = {};
  std::vector<RunSignals> runs;
  for (const FitLog& log : logs) add_runs_of_log(log, config, is_for_phases, report, runs);
  for (const RunSignals& run : runs) {
    const std::size_t skipped = skipped_steps(run, config.skip);
    report.seconds += static_cast<double>(run.steps() - skipped) * run.period();
    for (const scoring::ContactSequence& contact : run.contact) {
      for (std::size_t k = 0; k < contact.size(); ++k) {
        ++(k < skipped ? skipped_samples : report.samples)[contact[k] & 1U];
      }
    }
  }
  const bool share_legs = std::all_of(runs.begin(), runs.end(), [&](const RunSignals& run) {
    return run.legs == runs.front().legs;
  });
  if (share_legs && !runs.empty()) report.fitted_to.legs = runs.front().legs;
  return runs;
}

/// How often a wheel leaves the ground in the used parts of the runs.
std::size_t takeoffs_of_wheels(const std::vector<RunSignals>& runs, double skip) {
  std::size_t takeoffs = 0;
  for (const RunSignals& run : runs) {
    for (const scoring::ContactSequence& contact : run.contact) {
      for (const scoring::Flight& flight : scoring::flights(contact)) {
        if (flight.takeoff > skipped_steps(run, skip)) ++takeoffs;
      }
    }
  }
  return takeoffs;
}

/// Whether both wheels leave the ground together in the used part of the run.
bool has_takeoff(const RunSignals& run, std::size_t skipped) {
  const scoring::ContactSequence any = scoring::any_wheel(run.contact);
  const std::vector<scoring::Flight> all = scoring::flights(any);
  return std::any_of(all.begin(), all.end(),
                     [&](const scoring::Flight& flight) { return flight.takeoff > skipped; });
}

std::vector<RunSignals> logs_with_takeoffs(std::span<const FitLog> logs, const LogFitConfig& config,
                                           LogFitReport& report) {
  for (const FitLog& log : logs) {
    if (!log.contact) continue;
    throw InputError(fmt::format(
        "{}: phase and hmm learn how wheels leave the ground and land: they are fitted to "
        "logs with ground truth or --labels, not to --contact and --no-contact",
        log.path.string()));
  }
  ClassCounts skipped{};
  std::vector<RunSignals> runs = signals_of_logs(logs, config, true, report, skipped);
  const bool takeoff = std::any_of(runs.begin(), runs.end(), [&](const RunSignals& run) {
    return has_takeoff(run, skipped_steps(run, config.skip));
  });
  if (!takeoff) {
    const std::size_t of_one_wheel = takeoffs_of_wheels(runs, config.skip);
    const bool has_gaps = std::ranges::any_of(logs, [](const FitLog& log) {
      if (!log.labels) return false;
      const auto& all = log.labels->intervals;
      return std::ranges::adjacent_find(all, [](const auto& one, const auto& next) {
               return one.end < next.start;
             }) != all.end();
    });
    throw InputError(fmt::format(
        "fit: phase and hmm learn from takeoffs of both wheels, and the logs hold none{}{}",
        of_one_wheel > 0 ? fmt::format(", only {} of one wheel", of_one_wheel) : "",
        has_gaps ? "; a takeoff in a gap between labels does not count" : ""));
  }
  return runs;
}

std::vector<RunSignals> logs_of_both_classes(std::span<const FitLog> logs,
                                             const LogFitConfig& config, LogFitReport& report) {
  ClassCounts skipped{};
  std::vector<RunSignals> runs = signals_of_logs(logs, config, false, report, skipped);
  require_both_classes(report.samples, skipped, config.skip);
  report.takeoffs = takeoffs_of_wheels(runs, config.skip);
  return runs;
}

Model fit_model(const EstimatorEntry& entry, std::span<const FitLog> logs,
                const LogFitConfig& config, const EstimatorEntry* without_takeoffs,
                LogFitReport& report) {
  if (entry.fitting.torques) {
    return {.grid = fit_measurement_to_logs(logs, *entry.fitting.torques, config, report)};
  }
  const std::vector<RunSignals> runs = entry.fitting.phases
                                           ? logs_with_takeoffs(logs, config, report)
                                           : logs_of_both_classes(logs, config, report);
  FitRuns fitted;
  fitted.whole = pointers_to(runs);
  fitted.scoring.skip = config.skip;
  fitted.before_density = [&] { end_if(config.stop); };
  fitted.servo_load = config.servo_load;
  if (without_takeoffs == nullptr || report.takeoffs.value_or(1) > 0) return entry.fit(fitted);
  report.replaced = true;
  return without_takeoffs->fit(fitted);
}

}  // namespace

Model fit_to_logs(const EstimatorEntry& entry, std::span<const FitLog> logs,
                  const LogFitConfig& config, LogFitReport& report,
                  const EstimatorEntry* without_takeoffs) {
  check_names(config.hyperparameters, entry);
  if (config.prior) check_prior(*config.prior, entry, config.servo_load);
  Model model = fit_model(with_hyperparameters(entry, config.hyperparameters), logs, config,
                          without_takeoffs, report);
  const auto& [without, with] = report.declared_load;
  if (with.sum * without.count < without.sum * with.count) {
    report.warnings.push_back(fmt::format(
        "the torques give a wheel {:.0f} N in the logs after --contact and {:.0f} N in those after "
        "--no-contact: are they exchanged?",
        with.sum / with.count, without.sum / without.count));
  }
  std::vector<std::string> digests;
  for (const auto& [digest, name] : report.digests) digests.push_back(digest);
  add_to_provenance("logs", fmt::format("{}", fmt::join(digests, ", ")), model);
  if (!config.robot.name.empty()) report.fitted_to.robots = {config.robot.name};
  if (config.robot.legs) report.fitted_to.legs = *config.robot.legs;
  report.fitted_to.servo_load = config.servo_load;
  model.metadata =
      new_metadata((report.replaced ? *without_takeoffs : entry).name, report.fitted_to);
  if (config.prior) add_prior(*config.prior, report, model);
  put_into(*model.metadata, config.hyperparameters);
  return model;
}

}  // namespace touchdown::experiments
