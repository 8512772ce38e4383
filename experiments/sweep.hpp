#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "experiments/experiment.hpp"
#include "experiments/fitting.hpp"
#include "experiments/run_plan.hpp"
#include "experiments/score.hpp"

namespace touchdown {

/// Who listens to what: an estimator fitted on one engine's runs, tested on another's or the same.
struct Condition {
  std::string fit_simulator;
  std::string test_simulator;
  std::string estimator;
};

/// Every combination of the experiment's noise levels: torque by torque, accelerometer within; then
/// knee by knee, wheel within, without those that were there already.
std::vector<NoiseCell> noise_cells(const NoiseGridConfig& noise);

/// The experiment's estimators on the engine they were fitted on, "always contact" last.
std::vector<Condition> own_engine_conditions(const Experiment& experiment);

/// The key of one noise realisation; independent of everything else that the seed decides.
NoiseKey noise_key(const Experiment& experiment, int noise_seed, std::int64_t run);

/// A fresh estimator as the condition wants it, for runs with this control period.
std::unique_ptr<ContactEstimator> make_estimator(const Condition& condition,
                                                 const FittedModels& models,
                                                 std::int64_t control_period_us);

/// Point-wise counts of one condition: `samples[c][i]` belongs to cell c and statistical sample i
/// (a run or a drop), both wheels and all noise seeds added.
struct ConditionCounts {
  Condition condition;
  std::vector<std::vector<Classification>> samples;
};

/// Called with the number of noise cells that were evaluated since, which may be none; false stops
/// the work.
using SweepProgress = std::function<bool(std::int64_t cells)>;

/// Lets every condition listen to every test run through every noise cell and seed. Recordings and
/// noise draws are shared by all cells and conditions. Counts are integers, so that the result does
/// not depend on how the tasks are spread over threads. Errors: `Stopped`.
std::vector<ConditionCounts> sweep(const Experiment& experiment,
                                   const std::vector<Condition>& conditions,
                                   const std::vector<NoiseCell>& cells,
                                   const std::vector<const HeardRun*>& test_runs,
                                   const FittedModels& models, const SweepProgress& progress);

/// How many cells the above will report in all.
std::int64_t sweep_size(const Experiment& experiment, const std::vector<Condition>& conditions,
                        const std::vector<NoiseCell>& cells,
                        const std::vector<const HeardRun*>& test_runs);

/// Full scores of one condition at one noise setting; one entry per statistical sample.
struct ConditionScores {
  Condition condition;
  std::vector<RobotScore> samples;
};

/// As `sweep`, with transitions, calibration and all views, at one noise setting.
std::vector<ConditionScores> score_conditions(const Experiment& experiment,
                                              const std::vector<Condition>& conditions,
                                              const NoiseCell& cell, int seeds,
                                              const std::vector<const HeardRun*>& test_runs,
                                              const FittedModels& models,
                                              const SweepProgress& progress);

}  // namespace touchdown
