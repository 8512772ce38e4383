#include "experiments/logs/fit.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <iterator>

#include <fmt/format.h>

#include "core/error.hpp"
#include "estimator/bayes/measurement_fit.hpp"
#include "estimator/signal_guard.hpp"
#include "experiments/logs/log_steps.hpp"
#include "experiments/signals/reserved_seeds.hpp"
#include "experiments/signals/run_signals.hpp"
#include "scoring/labels.hpp"

namespace touchdown::experiments {

namespace {

recordings::LogReader reader_of(const FitLog& log, const LogFitConfig& config) {
  if (!log.records) return recordings::LogReader(log.path, config.stop);
  return recordings::LogReader(recordings::memory_source(log.records, config.stop),
                               log.path.string());
}

/// Adds the reader's warnings to the report. Errors: `Stopped`.
void add_warnings(const recordings::LogReader& reader, const LogFitConfig& config,
                  LogFitReport& report) {
  if (config.stop != nullptr && *config.stop) throw Stopped("stopped; no model was written");
  report.warnings.insert(report.warnings.end(), reader.warnings().begin(), reader.warnings().end());
}

/// Adds the log's rate and robot to the report.
void add_source(const LogSteps& steps, recordings::RecordingInfo info, LogFitReport& report) {
  info.control_period_us = steps.period_us();
  report.fitted_to.add(info);
}

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

/// Errors: `InputError` for labels that cover no step of the log.
void check_labelled(const FitLog& log, std::int64_t used, double last_time) {
  if (!log.labels || used > 0) return;
  throw InputError(fmt::format(
      "{}: none of its intervals, from {:.3f} to {:.3f} s, covers a step of {}, which ends at "
      "{:.3f} s: expected times as `touchdown estimate` prints them",
      log.labels->file, log.labels->intervals.front().start, log.labels->intervals.back().end,
      log.path.string(), last_time));
}

/// Compares the declared class of a log with its own ground truth, if it has any.
class DeclaredClass {
 public:
  DeclaredClass(const FitLog& log, const LogFitConfig& config)
      : log_(log), threshold_(config.labels.force_threshold) {}

  void add(const LogStep& step) {
    if (!log_.contact || !step.normal_force) return;
    for (const double force : *step.normal_force) {
      ++labelled_;
      contradicting_ += (force > threshold_) != *log_.contact ? 1 : 0;
    }
  }

  /// Errors: `InputError` for a log that is the other class most of the time.
  void check() const {
    if (2 * contradicting_ <= labelled_) return;
    throw InputError(fmt::format(
        "{}: is declared {}, but its own ground truth contradicts this for {:.1f} % of the steps: "
        "are --contact and --no-contact swapped?",
        log_.path.string(), *log_.contact ? "--contact" : "--no-contact",
        100.0 * static_cast<double>(contradicting_) / static_cast<double>(labelled_)));
  }

 private:
  const FitLog& log_;
  double threshold_;
  std::int64_t labelled_ = 0;  ///< steps, both wheels added
  std::int64_t contradicting_ = 0;
};

/// Errors: `InputError` for a step without ground truth or labels of contact.
void check_truth(const FitLog& log, const LogStep& step) {
  if (log.contact || log.labels || step.normal_force) return;
  throw InputError(
      fmt::format("{}: at {:.3f} s: no ground truth of contact: name the log after --contact or "
                  "--no-contact if all of it is one class, or give the intervals with --labels",
                  log.path.string(), step.signals.time));
}

void read_log(const FitLog& log, const BayesFilterConfig& filter, const LogFitConfig& config,
              const Sink& sink, LogFitReport& report) {
  recordings::LogReader reader = reader_of(log, config);
  LogSteps steps(reader, log.labels.get());
  check_may_be_fitted(reader.info());
  add_source(steps, reader.info(), report);
  const TorqueConfig& torque = filter.measurement.torque;
  std::array<LabelledLeg, models::wheel_count> legs = {
      LabelledLeg(torque, Side::left, steps, config.labels, sink),
      LabelledLeg(torque, Side::right, steps, config.labels, sink)};
  const auto skipped = std::llround(config.skip / steps.period());
  double before = NAN;
  std::int64_t k = 0;
  std::int64_t used = 0;
  DeclaredClass declared(log, config);
  for (; const LogStep* step = steps.next(); ++k) {
    check_truth(log, *step);
    declared.add(*step);
    const bool is_used = k >= skipped && (!log.labels || step->normal_force);
    if (is_used) ++used;
    for (std::size_t side = 0; side < legs.size(); ++side) {
      if (k > 0 && is_gap(step->signals.time - before, filter.guard)) legs[side].restart();
      const double force = step->normal_force ? (*step->normal_force)[side] : 0.0;
      const std::optional<bool> contact = log.labels ? std::optional(force > 0.0) : log.contact;
      if (!legs[side].add(step->signals.leg[side], !is_used, contact, force)) {
        ++report.unusable;
      }
    }
    before = step->signals.time;
  }
  add_warnings(reader, config, report);
  declared.check();
  check_labelled(log, used, before);
  for (LabelledLeg& leg : legs) leg.finish();
  report.seconds += static_cast<double>(used) * steps.period();
}

/// Errors: `InputError` without samples of one class.
void require_both_classes(std::size_t no_contact, std::size_t contact) {
  if (no_contact < 2) {
    throw InputError(
        "fit: no step of the logs is without contact: add a log with flights, or one of a robot "
        "that hangs after --no-contact");
  }
  if (contact < 2) {
    throw InputError(
        "fit: no step of the logs is in contact: add a log of a robot that rolls, after --contact "
        "if it has no ground truth");
  }
}

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
  require_both_classes(fit.count(false), fit.count(true));
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

/// Errors: `InputError` for a step that the phase filter cannot be fitted to.
void check_step(const FitLog& log, const LogStep& step, double before) {
  const auto refuse = [&](std::string_view what) {
    throw InputError(
        fmt::format("{}: at {:.3f} s: {}", log.path.string(), step.signals.time, what));
  };
  if (!step.normal_force) {
    refuse("no ground truth of contact, which the phase filter has to be fitted with");
  }
  if (!std::isfinite(step.signals.vertical_acceleration) || !has_torques(step.signals.leg[0]) ||
      !has_torques(step.signals.leg[1])) {
    refuse("a torque or the acceleration is not finite, or beyond what a sensor measures");
  }
  const double elapsed = step.signals.time - before;
  if (elapsed < 0.0 || elapsed > SignalGuardConfig{}.maximum_gap) {
    refuse("time jumps: the phase filter has to be fitted to logs without gaps");
  }
}

/// Throws `InputError` for a step that cannot be used.
using CheckStep = void (*)(const FitLog& log, const LogStep& step, double before);

/// Collects the steps of one run. A label follows once no later step can change it.
class LabelledRun {
 public:
  LabelledRun(const recordings::RecordingInfo& info, const scoring::LabelConfig& labels)
      : labels_{labels_of(0, info, labels), labels_of(1, info, labels)} {
    run_.info = info;
  }
  LabelledRun(const LabelledRun&) = delete;
  LabelledRun& operator=(const LabelledRun&) = delete;

  void add(const LogStep& step, std::optional<bool> declared) {
    for (std::size_t wheel = 0; wheel < labels_.size(); ++wheel) {
      if (declared) {
        run_.contact[wheel].push_back(*declared ? 1 : 0);
        continue;
      }
      labels_[wheel].add((*step.normal_force)[wheel]);
      run_.normal_force[wheel].push_back((*step.normal_force)[wheel]);
    }
    run_.signals.push_back(step.signals);
  }

  double last_time() const { return run_.signals.back().time; }

  RunSignals finish() {
    for (scoring::LabelStream& of_wheel : labels_) of_wheel.finish();
    return std::move(run_);
  }

 private:
  scoring::LabelStream labels_of(std::size_t wheel, const recordings::RecordingInfo& info,
                                 const scoring::LabelConfig& labels) {
    return {1e-6 * static_cast<double>(info.control_period_us), labels,
            [this, wheel](std::uint8_t contact) { run_.contact[wheel].push_back(contact); }};
  }

  RunSignals run_;
  std::array<scoring::LabelStream, models::wheel_count> labels_;
};

/// The log as one run, or as one run per labelled segment.
void add_runs_of_log(const FitLog& log, const LogFitConfig& config, CheckStep check,
                     LogFitReport& report, std::vector<RunSignals>& runs) {
  recordings::LogReader reader = reader_of(log, config);
  LogSteps steps(reader, log.labels.get());
  recordings::RecordingInfo info = reader.info();
  info.control_period_us = steps.period_us();
  add_source(steps, info, report);
  DeclaredClass declared(log, config);
  std::optional<LabelledRun> run;
  const auto finish = [&] {
    if (run) runs.push_back(run->finish());
    run.reset();
  };
  std::int64_t used = 0;
  double last_time = 0.0;
  while (const LogStep* step = steps.next()) {
    last_time = step->signals.time;
    if (log.labels && !step->normal_force) {
      finish();
      continue;
    }
    declared.add(*step);
    check(log, *step, run ? run->last_time() : NAN);
    if (!run) run.emplace(info, config.labels);
    run->add(*step, log.contact);
    ++used;
  }
  finish();
  add_warnings(reader, config, report);
  declared.check();
  check_labelled(log, used, last_time);
}

/// Loads all logs into memory, and adds to the report how much of them is used.
std::vector<RunSignals> signals_of_logs(std::span<const FitLog> logs, const LogFitConfig& config,
                                        CheckStep check, LogFitReport& report) {
  report = {};
  std::vector<RunSignals> runs;
  for (const FitLog& log : logs) add_runs_of_log(log, config, check, report, runs);
  for (RunSignals& run : runs) {
    run.legs = config.robot.legs.value_or(LegGeometry{});
    const std::size_t skipped = skipped_steps(run, config.skip);
    report.seconds += static_cast<double>(run.steps() - skipped) * period_of(run);
    for (const scoring::ContactSequence& contact : run.contact) {
      for (std::size_t k = skipped; k < contact.size(); ++k) ++report.samples[contact[k] & 1U];
    }
  }
  return runs;
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
        "{}: the phase filter learns how wheels leave the ground and land: it has to be fitted "
        "to logs with ground truth or --labels, not to --contact and --no-contact",
        log.path.string()));
  }
  std::vector<RunSignals> runs = signals_of_logs(logs, config, check_step, report);
  const bool takeoff = std::any_of(runs.begin(), runs.end(), [&](const RunSignals& run) {
    return has_takeoff(run, skipped_steps(run, config.skip));
  });
  if (!takeoff) {
    throw InputError("fit: the phase filter learns from takeoffs, and the logs hold none");
  }
  return runs;
}

std::vector<RunSignals> logs_of_both_classes(std::span<const FitLog> logs,
                                             const LogFitConfig& config, LogFitReport& report) {
  std::vector<RunSignals> runs = signals_of_logs(
      logs, config,
      [](const FitLog& log, const LogStep& step, double /*before*/) { check_truth(log, step); },
      report);
  require_both_classes(report.samples[0], report.samples[1]);
  return runs;
}

FittedModel fit_model(const EstimatorEntry& entry, std::span<const FitLog> logs,
                      const LogFitConfig& config, LogFitReport& report) {
  if (entry.config) {
    return {.measurement = fit_measurement_to_logs(logs, *entry.config, config, report)};
  }
  const std::vector<RunSignals> runs = entry.phase ? logs_with_takeoffs(logs, config, report)
                                                   : logs_of_both_classes(logs, config, report);
  FitRuns fitted;
  for (const RunSignals& run : runs) fitted.whole.push_back(&run);
  fitted.scoring.skip = config.skip;
  return entry.fit(entry, fitted);
}

}  // namespace

FittedModel fit_to_logs(const EstimatorEntry& entry, std::span<const FitLog> logs,
                        const LogFitConfig& config, LogFitReport& report) {
  check_names(config.hyperparameters, entry);
  FittedModel model =
      fit_model(with_hyperparameters(entry, config.hyperparameters), logs, config, report);
  if (!config.robot.name.empty()) report.fitted_to.robots = {config.robot.name};
  report.fitted_to.legs = config.robot.legs.value_or(LegGeometry{});
  model.metadata = new_metadata(entry.name, report.fitted_to);
  put_into(*model.metadata, config.hyperparameters);
  return model;
}

}  // namespace touchdown::experiments
