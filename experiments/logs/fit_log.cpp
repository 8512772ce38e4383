#include <cmath>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/stop.hpp"
#include "experiments/logs/fit.hpp"
#include "experiments/signals/reserved_seeds.hpp"
#include "logs/log/recording_file.hpp"

namespace touchdown::experiments {

namespace {

logs::LogReader reader_of(const FitLog& log, const LogFitConfig& config) {
  if (!log.recording) return logs::LogReader(log.path, config.stop);
  return {logs::records_of(log.recording, config.stop), log.path.string()};
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
      reader_(reader_of(log, config)),
      robot_(checked_robot(config.robot, reader_.info())),
      steps_(reader_, log.labels.get(), robot_),
      loads_(legs(), steps_.sample_rate()),
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
  compare_with_declared_class();
  return step_;
}

bool FitLogSteps::is_covered() const {
  const auto part = static_cast<std::int64_t>(std::floor(step_->signals.time / part_length));
  return (!log_.labels || step_->normal_force) && (!log_.part || (part & 1) == *log_.part);
}

void FitLogSteps::require_truth() const {
  if (log_.contact || log_.labels || step_->normal_force) return;
  throw InputError(
      fmt::format("{}: at {:.3f} s: no ground truth of contact: name the log after --contact or "
                  "--no-contact if all of it is one class, or give the intervals with --labels",
                  log_.path.string(), step_->signals.time));
}

void FitLogSteps::compare_with_declared_class() {
  if (!log_.contact) return;
  const DynamicLoads::Loads measured = loads_.update(step_->signals);
  LogFitReport::DeclaredLoad& load = report_.declared_load.at(*log_.contact ? 1 : 0);
  for (std::size_t side = 0; side < models::wheel_count; ++side) {
    if (!std::isfinite(measured[side].force)) continue;
    load.sum += measured[side].force;
    load.count += 1.0;
  }
  if (!step_->normal_force || step_->signals.time < config_.skip) return;
  for (const double force : *step_->normal_force) {
    ++compared_;
    const double threshold = scoring::force_threshold(config_.labels, robot_mass());
    if ((force > threshold) == *log_.contact) continue;
    if (contradicting_++ == 0) first_contradiction_ = step_->signals.time;
  }
}

void FitLogSteps::finish(std::int64_t used_steps) {
  end_if(config_.stop);
  steps_.require_labels_within();
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

}  // namespace touchdown::experiments
