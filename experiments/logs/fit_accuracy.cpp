#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "core/error.hpp"
#include "core/stop.hpp"
#include "experiments/logs/estimator.hpp"
#include "experiments/logs/fit.hpp"
#include "experiments/logs/summary.hpp"

namespace touchdown::experiments {

namespace {

/// Adds the score of an estimator on the covered steps of a log with contact that is known by its
/// truth, labels or class.
void add_score(const LogEstimator& chosen, const FitLog& log, const LogFitConfig& config,
               scoring::RobotScore& total) {
  LogFitReport unused;
  FitLogSteps reader(log, config, unused);
  const auto estimator = chosen.make(reader.steps().sample_rate(), reader.info());
  LogScore score(reader.steps().period_us(), config.labels, reader.robot_mass(),
                 {.skip = config.skip}, true);
  while (const LogStep* step = reader.next()) {
    const Belief& belief = estimator->update(step->signals);
    score.add(reader.is_covered() ? step->normal_force : std::nullopt, belief);
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

/// Nothing with one fold alone, or if a fold's logs lack a class or a takeoff.
std::optional<double> held_out(const EstimatorEntry& entry, const std::vector<Fold>& folds,
                               const LogFitConfig& config) {
  if (folds.size() < 2) return {};
  std::vector<scoring::RobotScore> scores(folds.size());
  std::atomic<bool> is_judged = true;
  tbb::parallel_for(std::size_t{0}, folds.size(), [&](std::size_t fold) {
    LogFitReport unused;
    Model other;
    try {
      other = fit_to_logs(entry, folds[fold].fitted, config, unused);
    } catch (const InputError&) {
      is_judged = false;
      return;
    }
    const LogEstimator estimator = log_estimator(entry, std::move(other), config.robot);
    for (const FitLog& log : folds[fold].tested) add_score(estimator, log, config, scores[fold]);
  });
  if (!is_judged) return {};
  const double accuracy = balanced(scores);
  return std::isnan(accuracy) ? std::nullopt : std::optional(accuracy);
}

std::vector<scoring::RobotScore> scores_on(std::span<const FitLog> logs,
                                           const LogEstimator& estimator,
                                           const LogFitConfig& config) {
  std::vector<scoring::RobotScore> scores(logs.size());
  tbb::parallel_for(std::size_t{0}, logs.size(),
                    [&](std::size_t i) { add_score(estimator, logs[i], config, scores[i]); });
  return scores;
}

}  // namespace

FitAccuracy accuracy_of_fit(const EstimatorEntry& entry, std::span<const FitLog> logs,
                            const LogFitConfig& config, const Model& model) {
  FitAccuracy accuracy;
  accuracy.held_out = held_out(entry, folds_of(logs, false), config);
  if (!accuracy.held_out) {
    accuracy.held_out = held_out(entry, folds_of(logs, true), config);
    accuracy.by_parts = accuracy.held_out.has_value();
  }
  accuracy.fitted = balanced(scores_on(logs, log_estimator(entry, model, config.robot), config));
  const std::vector<scoring::RobotScore> scores =
      scores_on(logs, log_estimator({.robot = config.robot}), config);
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
