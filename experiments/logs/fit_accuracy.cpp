#include <algorithm>
#include <atomic>
#include <limits>

#include <tbb/parallel_for.h>

#include "core/error.hpp"
#include "experiments/logs/estimator.hpp"
#include "experiments/logs/fit.hpp"
#include "experiments/logs/summary.hpp"

namespace touchdown::experiments {

namespace {

/// Adds the score of a model on a log with contact that is known by its truth, labels or class.
void add_score(const EstimatorEntry& entry, const Model& model, const FitLog& log,
               const LogFitConfig& config, scoring::RobotScore& total) {
  LogFitReport unused;
  FitLogSteps reader(log, config, unused);
  const LogEstimator chosen = log_estimator(entry, model, config.robot);
  const auto estimator = chosen.make(reader.steps().sample_rate(), reader.info());
  LogScore score(reader.steps().period_us(), config.labels, {.skip = config.skip}, true);
  while (const LogStep* step = reader.next()) {
    LogStep known = *step;
    if (log.contact) {
      const double force = *log.contact ? std::numeric_limits<double>::infinity() : 0.0;
      known.normal_force = {force, force};
    }
    score.add(known, estimator->update(step->signals));
  }
  stop_if_asked(config);
  if (const auto scored = score.finish()) total += *scored;
}

}  // namespace

FitAccuracy accuracy_of_fit(const EstimatorEntry& entry, std::span<const FitLog> logs,
                            const LogFitConfig& config, const Model& model) {
  constexpr std::size_t most_folds = 5;
  const std::size_t folds = logs.size() < 2 ? 0 : std::min(logs.size(), most_folds);
  std::vector<scoring::RobotScore> held_out(folds);
  std::atomic<bool> is_judged = folds > 0;
  tbb::parallel_for(std::size_t{0}, folds, [&](std::size_t fold) {
    std::vector<FitLog> others;
    for (std::size_t i = 0; i < logs.size(); ++i) {
      if (i % folds != fold) others.push_back(logs[i]);
    }
    LogFitReport unused;
    Model other;
    try {
      other = fit_to_logs(entry, others, config, unused);
    } catch (const InputError&) {
      is_judged = false;  // the others lack a class or a takeoff
      return;
    }
    for (std::size_t i = fold; i < logs.size(); i += folds) {
      add_score(entry, other, logs[i], config, held_out[fold]);
    }
  });
  scoring::RobotScore fitted;
  for (const FitLog& log : logs) add_score(entry, model, log, config, fitted);
  FitAccuracy accuracy{fitted.wheels().points.success()};
  if (!is_judged) return accuracy;
  scoring::RobotScore all;
  for (const scoring::RobotScore& one : held_out) all += one;
  accuracy.held_out = all.wheels().points.success();
  return accuracy;
}

}  // namespace touchdown::experiments
