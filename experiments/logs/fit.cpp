#include "experiments/logs/fit.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/stop.hpp"
#include "estimator/bayes/measurement_fit.hpp"
#include "estimator/signal_guard.hpp"
#include "experiments/signals/reserved_seeds.hpp"
#include "logs/log/recording_file.hpp"

namespace touchdown::experiments {

namespace {

logs::LogReader reader_of(const FitLog& log, const LogFitConfig& config) {
  if (!log.recording) return logs::LogReader(log.path, config.stop);
  return {logs::records_of(log.recording, config.stop), log.path.string()};
}

/// A declared class is a label of all times.
std::shared_ptr<const logs::ContactIntervals> labels_of(const FitLog& log) {
  if (!log.contact) return log.labels;
  constexpr double ever = std::numeric_limits<double>::infinity();
  return std::make_shared<const logs::ContactIntervals>(
      logs::ContactIntervals{{}, {{-ever, ever, {*log.contact, *log.contact}}}});
}

using Samples = std::array<std::vector<TorqueSample>, 2>;  ///< without contact, in contact

void read_log(const FitLog& log, const TorqueConfig& torque, const LogFitConfig& config,
              Samples& samples, LogFitReport& report) {
  FitLogSteps reader(log, config, report);
  const LogSteps& steps = reader.steps();
  /// Samples of a leg wait until later forces decide about their labels.
  std::array<std::deque<std::optional<TorqueSample>>, models::wheel_count> waiting;
  const auto label = [&](std::size_t side) {
    return [&samples, &own = waiting.at(side)](bool contact) {
      if (own.front()) samples.at(contact ? 1 : 0).push_back(*own.front());
      own.pop_front();
    };
  };
  const auto labels_of = [&](std::size_t side) {
    return scoring::LabelStream(steps.period(), reader.robot_mass(), config.labels, label(side));
  };
  std::array<scoring::LabelStream, models::wheel_count> labels = {labels_of(0), labels_of(1)};
  std::array<TorqueChannel, models::wheel_count> channels = {
      TorqueChannel(torque, Side::left, steps.sample_rate()),
      TorqueChannel(torque, Side::right, steps.sample_rate())};
  const auto skipped = std::llround(config.skip / steps.period());
  double before = NAN;
  std::int64_t k = 0;
  std::int64_t used = 0;
  for (; const LogStep* step = reader.next(); ++k) {
    const bool is_used = k >= skipped && reader.is_covered();
    if (is_used) ++used;
    const double elapsed = step->signals.time - before;
    before = step->signals.time;
    const bool is_gap = !(elapsed >= 0.0 && elapsed <= SignalGuardConfig{}.maximum_gap);
    for (std::size_t side = 0; side < channels.size(); ++side) {
      if (k > 0 && is_gap) channels.at(side).reset();
      std::optional<TorqueSample> sample;
      if (has_torques(step->signals.leg[side])) {
        sample = channels.at(side).update(step->signals.leg[side]);
      } else {
        ++report.unusable;
      }
      waiting.at(side).push_back(is_used ? sample : std::nullopt);
      const double force = step->normal_force ? (*step->normal_force)[side] : 0.0;
      if (log.has_labels()) {
        label(side)(force > 0.0);
      } else {
        labels.at(side).add(force);
      }
    }
  }
  reader.finish(used);
  for (scoring::LabelStream& one : labels) one.finish();
  report.fitted_to.seconds += static_cast<double>(used) * steps.period();
}

/// Errors: `InputError` without samples of one class; index 0 is no contact, 1 is contact.
void require_both_classes(const Samples& samples) {
  for (const std::size_t of_class : {0U, 1U}) {
    if (samples[of_class].size() >= 2) continue;
    throw InputError(fmt::format(
        "fit: no step of the logs is {}: add a log {}",
        of_class == 0 ? "without contact" : "in contact",
        of_class == 0 ? "with flights, or one of a robot that hangs after --no-contact"
                      : "of a robot that rolls, after --contact if it has no ground truth"));
  }
}

std::string provenance_text(const Model& model) {
  const auto found = model.arrays.find(std::string(provenance_array));
  return found == model.arrays.end() ? std::string() : text_of_array(found->second, found->first);
}

/// Whether the provenance has a line of this key with the value among others.
bool names(const std::string& provenance, std::string_view key, const std::string& value) {
  const std::string lines = "\n" + provenance;
  const std::size_t begin = lines.find(fmt::format("\n{}: ", key));
  if (begin == std::string::npos || value.empty()) return false;
  const std::size_t values = begin + 1 + key.size() + 1;
  const std::string line = lines.substr(values, lines.find('\n', values) - values) + ",";
  return line.find(fmt::format(" {},", value)) != std::string::npos;
}

}  // namespace

bool was_fitted_to(const Model& model, const LogSteps& log, const logs::RecordingInfo& info) {
  const std::string provenance = provenance_text(model);
  const bool is_run = names(provenance, "scenarios", info.scenario) &&
                      names(provenance, "simulators", info.simulator) &&
                      names(provenance, "seed:run", fmt::format("{}:{}", info.seed, info.run));
  return is_run || names(provenance, "logs", log.digest());
}

FitLogSteps::FitLogSteps(const FitLog& log, const LogFitConfig& config, LogFitReport& report)
    : log_(log),
      config_(config),
      report_(report),
      labels_(labels_of(log)),
      reader_(reader_of(log, config)),
      robot_(checked_robot(config.robot, reader_.info())),
      steps_(reader_, labels_.get(), robot_),
      info_(reader_.info()) {
  check_may_be_fitted(info_);
  info_.control_period_us = steps_.period_us();
  const double fitted = report_.fitted_to.sample_rate;
  if (fitted > 0.0 && !is_same_rate(steps_.sample_rate(), fitted)) {
    throw InputError(fmt::format(
        "{}: {:.6g} steps per second, and the logs before it have {:.6g}: a model is fitted at one "
        "rate; resample the log, or fit another model",
        log.path.string(), steps_.sample_rate(), fitted));
  }
  if (fitted == 0.0) report_.fitted_to.sample_rate = steps_.sample_rate();
  report_.fitted_to.add(info_);
}

const LogStep* FitLogSteps::next() {
  step_ = steps_.next();
  if (step_ == nullptr) return nullptr;
  last_time_ = step_->signals.time;
  if (log_.contact) {
    compare_with_declared_class();
  } else if (!log_.labels && !step_->normal_force) {
    throw InputError(
        fmt::format("{}: at {:.3f} s: no ground truth of contact: name the log after --contact or "
                    "--no-contact if all of it is one class, or give the intervals with --labels",
                    log_.path.string(), last_time_));
  }
  return step_;
}

bool FitLogSteps::is_covered() const {
  const auto part = static_cast<std::int64_t>(std::floor(last_time_ / part_length));
  return step_->normal_force && (!log_.part || (part & 1) == *log_.part);
}

void FitLogSteps::compare_with_declared_class() {
  LogFitReport::DeclaredLoad& load = report_.declared_load.at(*log_.contact ? 1 : 0);
  for (const WheelLoad& measured : steps_.loads()) {
    if (!std::isfinite(measured.force)) continue;
    load.sum += measured.force;
    load.count += 1.0;
  }
  if (!step_->truth || last_time_ < config_.skip) return;
  for (const double force : *step_->truth) {
    ++compared_;
    const double threshold = scoring::force_threshold(config_.labels, robot_mass());
    if ((force > threshold) == *log_.contact) continue;
    if (contradicting_++ == 0) first_contradiction_ = last_time_;
  }
}

void FitLogSteps::finish(std::int64_t used_steps) {
  end_if(config_.stop);
  if (log_.labels) steps_.require_labels_within();
  const auto [same, is_new] = report_.digests.emplace(steps_.digest(), log_.path.string());
  if (!is_new) {
    throw InputError(fmt::format("{} and {} are copies of one log, which would count twice",
                                 same->second, log_.path.string()));
  }
  for (std::string& warning : reader_.warnings()) report_.warnings.push_back(std::move(warning));
  for (const std::string& finding : steps_.findings()) {
    report_.warnings.push_back(fmt::format("{}: {}", log_.path.string(), finding));
  }
  constexpr double most_contradicting = 0.02;  // wheels that leave the ground for moments
  const double share =
      compared_ == 0 ? 0.0 : static_cast<double>(contradicting_) / static_cast<double>(compared_);
  if (share > most_contradicting) {
    const char* const declared = *log_.contact ? "--contact" : "--no-contact";
    throw InputError(fmt::format(
        "{}: is declared {}, but its own ground truth contradicts this for {:.1f} % of the steps, "
        "first at {:.3f} s: {}",
        log_.path.string(), declared, 100.0 * share, first_contradiction_,
        share > 0.5 ? "are --contact and --no-contact swapped?"
                    : fmt::format("name it without {}, so that this truth counts", declared)));
  }
  if (log_.labels && used_steps == 0) {
    throw InputError(fmt::format(
        "{}: none of its intervals, from {:.3f} to {:.3f} s, covers a step of {}, which ends at "
        "{:.3f} s: expected times as `touchdown estimate` prints them",
        log_.labels->file, log_.labels->intervals.front().start, log_.labels->intervals.back().end,
        log_.path.string(), last_time_));
  }
}

Model fit_to_logs(const EstimatorEntry& entry, std::span<const FitLog> logs,
                  const LogFitConfig& config, LogFitReport& report) {
  check_names(config.hyperparameters, entry);
  const EstimatorEntry chosen = with_hyperparameters(entry, config.hyperparameters);
  const MeasurementConfig& measurement = *chosen.fitting.torques;
  Samples samples;
  report = {};
  for (const FitLog& log : logs) {
    end_if(config.stop);
    read_log(log, measurement.torque, config, samples, report);
  }
  require_both_classes(samples);
  MeasurementFit fit = fit_measurement(samples[1], samples[0], measurement.fit);
  end_if(config.stop);
  report.samples = {samples[0].size(), samples[1].size()};
  report.bandwidth = fit.bandwidth;
  Model model{.grid = std::move(fit.model)};
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
