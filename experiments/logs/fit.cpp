#include "experiments/logs/fit.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <deque>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "core/error.hpp"
#include "core/progress.hpp"
#include "core/stop.hpp"
#include "estimator/bayes/measurement_fit.hpp"
#include "estimator/signal_guard.hpp"
#include "experiments/logs/estimator.hpp"
#include "experiments/logs/summary.hpp"
#include "experiments/signals/reserved_seeds.hpp"
#include "logs/log/byte_source.hpp"
#include "logs/log/recording_file.hpp"

namespace touchdown::experiments {

namespace {

constexpr std::size_t progress_unit = 1024;             // bytes
constexpr std::uintmax_t read_at_once = 32'000 * 1024;  // bytes: read in less than a second

/// A reading of logs, perhaps several times, and its progress.
class Reading {
 public:
  /// Each log is read `times`.
  Reading(const LogFitConfig& how, const char* what, std::span<const FitLog> logs,
          std::size_t times)
      : config(how) {
    std::uintmax_t bytes = 0;
    for (const FitLog& log : logs) {
      std::error_code error;
      const std::uintmax_t size = std::filesystem::file_size(log.path, error);
      if (!error) bytes += times * size;
    }
    if (!config.shows_progress || bytes < read_at_once) return;
    progress_.emplace(what, "kB", static_cast<std::int64_t>(bytes / progress_unit));
  }

  logs::LogReader open(const FitLog& log) {
    if (log.recording) return {logs::records_of(log.recording, config.stop), log.path.string()};
    if (!progress_ || log.path == "-") return logs::LogReader(log.path, config.stop);
    return {[this, bytes = logs::file_source(log.path, config.stop)](std::span<char> buffer) {
              const std::size_t size = bytes(buffer);
              progress_->advance(static_cast<std::int64_t>(size / progress_unit));
              return size;
            },
            log.path.string()};
  }

  const LogFitConfig& config;

 private:
  std::optional<Progress> progress_;
};

/// A declared class is a label of all times. Null: the log's own truth counts.
std::shared_ptr<const logs::ContactIntervals> labels_of(const FitLog& log) {
  if (!log.contact) return log.labels;
  constexpr double ever = std::numeric_limits<double>::infinity();
  return std::make_shared<const logs::ContactIntervals>(
      logs::ContactIntervals{{}, {{-ever, ever, {*log.contact, *log.contact}}}});
}

/// A log of a fit, opened.
struct OpenLog {
  OpenLog(const FitLog& log, Reading& reading)
      : labels(labels_of(log)),
        reader(reading.open(log)),
        steps(reader, labels.get(), reading.config.robot) {}

  std::shared_ptr<const logs::ContactIntervals> labels;
  logs::LogReader reader;
  LogSteps steps;
};

/// Whether the step is in the log's part, and in a labelled segment if it has labels.
bool is_covered(const LogStep& step, const FitLog& log) {
  const auto part = static_cast<std::int64_t>(std::floor(step.signals.time / part_length));
  return step.normal_force && (!log.part || (part & 1) == *log.part);
}

/// Errors: `InputError` for a log of a reserved seed, or of another rate than the logs before it.
void add_source(const FitLog& log, const LogSteps& steps, FittedTo& fitted_to) {
  check_may_be_fitted(steps.info());
  const double fitted = fitted_to.sample_rate;
  if (fitted > 0.0 && !is_same_rate(steps.sample_rate(), fitted)) {
    throw InputError(fmt::format(
        "{}: {:.6g} steps per second, and the logs before it have {:.6g}: a model is fitted at one "
        "rate; resample the log, or fit another model",
        log.path.string(), steps.sample_rate(), fitted));
  }
  if (fitted == 0.0) fitted_to.sample_rate = steps.sample_rate();
  fitted_to.add(steps.info());
}

/// How a log's own truth agrees with its declared class, in steps of a wheel.
struct Agreement {
  std::int64_t compared = 0;
  std::int64_t contradicting = 0;
  double first = 0.0;  ///< that contradicts (s)

  /// `threshold`: of contact (N).
  void add(const LogStep& step, bool declared, double threshold) {
    if (!step.truth) return;
    for (const double force : *step.truth) {
      ++compared;
      if ((force > threshold) == declared) continue;
      if (contradicting++ == 0) first = step.signals.time;
    }
  }
};

/// Errors: `InputError` for a log with a ground truth that contradicts its declared class at more
/// than 2 % of the steps.
void require_agreement(const Agreement& agreement, const FitLog& log) {
  constexpr double most_contradicting = 0.02;  // wheels that leave the ground for moments
  const double share = scoring::ratio(agreement.contradicting, agreement.compared);
  if (!(share > most_contradicting)) return;
  const char* const declared = *log.contact ? "--contact" : "--no-contact";
  throw InputError(fmt::format(
      "{}: is declared {}, but its own ground truth contradicts this for {:.1f} % of the steps, "
      "first at {:.3f} s: {}",
      log.path.string(), declared, 100.0 * share, agreement.first,
      share > 0.5 ? "are --contact and --no-contact swapped?"
                  : fmt::format("name it without {}, so that this truth counts", declared)));
}

/// Errors: `InputError` for a copy of a log before it.
void add_digest_and_warnings(const FitLog& log, const OpenLog& opened, LogFitReport& report) {
  const auto [same, is_new] = report.digests.emplace(opened.steps.digest(), log.path.string());
  if (!is_new) {
    throw InputError(fmt::format("{} and {} are copies of one log, which would count twice",
                                 same->second, log.path.string()));
  }
  for (std::string& warning : opened.reader.warnings()) {
    report.warnings.push_back(std::move(warning));
  }
  for (const std::string& finding : opened.steps.findings()) {
    report.warnings.push_back(fmt::format("{}: {}", log.path.string(), finding));
  }
}

using Samples = std::array<std::vector<TorqueSample>, 2>;  ///< without contact, in contact

/// Errors: `InputError` for a step without ground truth of contact, if there are no labels; those
/// of the functions above and of `LogSteps`.
void read_log(const FitLog& log, const TorqueConfig& torque, Reading& reading, Samples& samples,
              LogFitReport& report) {
  const LogFitConfig& config = reading.config;
  OpenLog opened(log, reading);
  LogSteps& steps = opened.steps;
  add_source(log, steps, report.fitted_to);
  /// Samples of a leg wait until later forces decide about their labels.
  std::array<std::deque<std::optional<TorqueSample>>, models::wheel_count> waiting;
  const auto label = [&](std::size_t side) {
    return [&samples, &own = waiting.at(side)](bool contact) {
      if (own.front()) samples.at(contact ? 1 : 0).push_back(*own.front());
      own.pop_front();
    };
  };
  const auto labels_of = [&](std::size_t side) {
    return scoring::LabelStream(steps.period(), steps.robot_mass(), config.labels, label(side));
  };
  std::array<scoring::LabelStream, models::wheel_count> labels = {labels_of(0), labels_of(1)};
  std::array<TorqueChannel, models::wheel_count> channels = {
      TorqueChannel(torque, Side::left, steps.sample_rate()),
      TorqueChannel(torque, Side::right, steps.sample_rate())};
  const auto skipped = std::llround(config.skip / steps.period());
  const double threshold = scoring::force_threshold(config.labels, steps.robot_mass());
  Agreement agreement;
  double time = NAN;
  std::int64_t used = 0;
  for (std::int64_t k = 0; const LogStep* step = steps.next(); ++k) {
    const double elapsed = step->signals.time - time;
    time = step->signals.time;
    if (!opened.labels && !step->normal_force) {
      throw InputError(fmt::format(
          "{}: at {:.3f} s: no ground truth of contact: name the log after --contact or "
          "--no-contact if all of it is one class, or give the intervals with --labels",
          log.path.string(), time));
    }
    if (log.contact) {
      report.declared_load.at(*log.contact ? 1 : 0).add(step->loads);
      if (!(time < config.skip)) agreement.add(*step, *log.contact, threshold);
    }
    const bool is_used = k >= skipped && is_covered(*step, log);
    if (is_used) ++used;
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
      if (opened.labels) {
        label(side)(force > 0.0);
      } else {
        labels.at(side).add(force);
      }
    }
  }
  end_if(config.stop);
  if (log.labels) steps.require_labels_within();
  add_digest_and_warnings(log, opened, report);
  require_agreement(agreement, log);
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

/// Adds the score of an estimator on the covered steps of a log with contact that is known by its
/// truth, labels or class.
void add_score(const LogEstimator& chosen, const FitLog& log, Reading& reading,
               scoring::RobotScore& total) {
  const LogFitConfig& config = reading.config;
  OpenLog opened(log, reading);
  LogSteps& steps = opened.steps;
  const auto estimator = chosen.make(steps.sample_rate(), steps.info());
  LogScore score(steps.period_us(), config.labels, steps.robot_mass(), {.skip = config.skip}, true);
  while (const LogStep* step = steps.next()) {
    const Belief& belief = estimator->update(step->signals);
    score.add(is_covered(*step, log) ? step->normal_force : std::nullopt, {}, belief);
  }
  end_if(config.stop);
  if (const auto scored = score.finish()) total += *scored;
}

double balanced(const std::vector<scoring::RobotScore>& scores) {
  scoring::RobotScore all;
  for (const scoring::RobotScore& one : scores) all += one;
  return all.wheels().points.balanced_accuracy();
}

/// What a model is fitted to, and what it is judged by.
struct Fold {
  std::vector<FitLog> fitted, tested;
};

std::vector<Fold> folds_of(std::span<const FitLog> logs, bool by_parts) {
  constexpr std::size_t most_folds = 5;
  std::vector<Fold> folds(by_parts ? 2 : std::min(logs.size(), most_folds));
  for (std::size_t i = 0; i < logs.size(); ++i) {
    FitLog log = logs[i];
    for (std::size_t fold = 0; fold < folds.size(); ++fold) {
      auto& [fitted, tested] = folds[fold];
      if (!by_parts) {
        (i % folds.size() == fold ? tested : fitted).push_back(log);
        continue;
      }
      log.part = static_cast<int>(fold);
      fitted.push_back(log);
      log.part = 1 - *log.part;
      tested.push_back(log);
    }
  }
  return folds;
}

Model model_of(const EstimatorEntry& entry, std::span<const FitLog> logs, Reading& reading,
               LogFitReport& report) {
  const LogFitConfig& config = reading.config;
  check_names(config.hyperparameters, entry);
  const EstimatorEntry chosen = with_hyperparameters(entry, config.hyperparameters);
  const MeasurementConfig& measurement = *chosen.fitting.torques;
  Samples samples;
  report = {};
  for (const FitLog& log : logs) {
    end_if(config.stop);
    read_log(log, measurement.torque, reading, samples, report);
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

/// Nothing if a fold's logs lack a class or a takeoff.
std::optional<double> held_out(const EstimatorEntry& entry, const std::vector<Fold>& folds,
                               Reading& reading) {
  std::vector<scoring::RobotScore> scores(folds.size());
  std::atomic<bool> is_judged = true;
  tbb::parallel_for(std::size_t{0}, folds.size(), [&](std::size_t fold) {
    LogFitReport unused;
    Model other;
    try {
      other = model_of(entry, folds[fold].fitted, reading, unused);
    } catch (const InputError&) {
      is_judged = false;
      return;
    }
    const LogEstimator estimator = log_estimator(entry, std::move(other), reading.config.robot);
    for (const FitLog& log : folds[fold].tested) {
      add_score(estimator, log, reading, scores[fold]);
    }
  });
  if (!is_judged) return {};
  const double accuracy = balanced(scores);
  return std::isnan(accuracy) ? std::nullopt : std::optional(accuracy);
}

std::vector<scoring::RobotScore> scores_on(std::span<const FitLog> logs,
                                           const LogEstimator& estimator, Reading& reading) {
  std::vector<scoring::RobotScore> scores(logs.size());
  tbb::parallel_for(std::size_t{0}, logs.size(),
                    [&](std::size_t i) { add_score(estimator, logs[i], reading, scores[i]); });
  return scores;
}

}  // namespace

bool was_fitted_to(const Model& model, const LogSteps& log) {
  const std::string provenance = provenance_text(model);
  const logs::RecordingInfo& info = log.info();
  const bool is_run = names(provenance, "scenarios", info.scenario) &&
                      names(provenance, "simulators", info.simulator) &&
                      names(provenance, "seed:run", fmt::format("{}:{}", info.seed, info.run));
  return is_run || names(provenance, "logs", log.digest());
}

Model fit_to_logs(const EstimatorEntry& entry, std::span<const FitLog> logs,
                  const LogFitConfig& config, LogFitReport& report) {
  Reading reading(config, "fitting", logs, 1);
  return model_of(entry, logs, reading, report);
}

FitAccuracy accuracy_of_fit(const EstimatorEntry& entry, std::span<const FitLog> logs,
                            const LogFitConfig& config, const Model& model) {
  FitAccuracy accuracy;
  for (const bool by_parts : {false, true}) {
    const std::vector<Fold> folds = folds_of(logs, by_parts);
    if (accuracy.held_out || folds.size() < 2) continue;
    Reading reading(config, "judging", logs, (by_parts ? 2 : 1) * folds.size());
    accuracy.held_out = held_out(entry, folds, reading);
    accuracy.by_parts = by_parts && accuracy.held_out;
  }
  Reading reading(config, "scoring", logs, 2);
  accuracy.fitted = balanced(scores_on(logs, log_estimator(entry, model, config.robot), reading));
  const std::vector<scoring::RobotScore> scores =
      scores_on(logs, log_estimator({.robot = config.robot}), reading);
  accuracy.load_filter = balanced(scores);
  for (std::size_t i = 0; i < logs.size(); ++i) {
    const scoring::Score score = scores[i].wheels();
    const double air =
        1e-6 * static_cast<double>(score.scored_us) * (1.0 - score.points.contact_recall());
    const auto takeoffs = static_cast<double>(score.takeoff.false_alarms);
    const bool flies = takeoffs > 0.0 && air >= scoring::ScoringConfig{}.minimum_flight * takeoffs;
    if (!flies || !logs[i].contact.value_or(false)) continue;
    accuracy.flights.push_back(fmt::format(
        "{0}: is declared --contact, and the loads of its wheels show {1} of a wheel, {2:.2f} s in "
        "all: look at `touchdown estimate {0}`, or give its intervals with --labels",
        logs[i].path.string(), takeoffs == 1.0 ? "a flight" : fmt::format("{:g} flights", takeoffs),
        air));
  }
  return accuracy;
}

}  // namespace touchdown::experiments
