#pragma once

#include <map>
#include <string>
#include <utility>

#include "experiments/fit_cost.hpp"
#include "experiments/plan/plan.hpp"
#include "experiments/rollouts/rollouts.hpp"

namespace touchdown::experiments {

/// Runs of one scene by one robot are about equally long in every engine.
using SceneKey = std::pair<std::string, std::string>;
SceneKey scene_key(const PlannedRun& run);

/// An evaluation: estimators are made once in a run, then updated step by step (s).
struct RunCost {
  double fixed = 0.0;
  double per_step = 0.0;
};

/// The evaluation of a run in all conditions of a group, without refits.
struct EvaluationCost {
  RunCost counted;
  RunCost scored;
  RunCost tried;  ///< the part of `scored` that is of estimators with trials
};

/// What a short calibration measures of an experiment on this machine.
struct Calibration {
  std::map<std::string, double> step_seconds;  ///< processor time per control step, by engine
  std::map<SceneKey, double> duration;         ///< of a simulated run (s)
  double share = 1.0;          ///< of the planned duration, for scenes without a simulated run
  FitSample fits;              ///< to a few seconds of runs of the first engine
  EvaluationCost evaluation;   ///< of a run on the first engine
  double memory_in_use = 0.0;  ///< by this process before (bytes)
  double measured = 0.0;       ///< duration of the calibration (s)
};

/// Simulates one run of every scene, fits every estimator to a few seconds of them, and evaluates
/// every estimator on a few seconds more. Writes nothing into run directories. Errors: `InputError`
/// for an invalid scene; `Stopped`.
Calibration calibrate(const RunRequest& request, const Plan& plan,
                      const ShouldContinue& should_continue);

/// Whether tuning has trials of this estimator.
bool is_tried(const std::string& estimator, const Experiment& experiment);

/// Control steps per second of a run.
double steps_per_second(const PlannedRun& run);

}  // namespace touchdown::experiments
