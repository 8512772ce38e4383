#pragma once

#include <map>
#include <string>
#include <vector>

#include "experiments/calibration.hpp"
#include "experiments/plan/plan.hpp"

namespace touchdown::experiments {

/// The estimated cost of one stage of an experiment.
struct StageCost {
  std::string stage;     ///< "simulate", "tune", "fit", "evaluate", "model_tasks"
  double seconds = 0.0;  ///< of processor time; NaN if it cannot be estimated
};

/// What an experiment will cost on this machine.
struct CostEstimate {
  std::vector<StageCost> stages;
  std::map<std::string, double> step_seconds;  ///< per control step, by engine
  double memory = 0.0;                         ///< at most at one time (bytes)
  double disk = 0.0;                           ///< at most, pictures included (bytes)
  double measured = 0.0;                       ///< duration of the calibration (s)
  std::vector<std::string> unmeasured_fits;    ///< estimators with fits in no stage

  double seconds() const;  ///< of the stages that can be estimated
};

/// Estimates the cost of a plan from a calibration. Costs grow linearly with the data, but for the
/// training of fits that draw a fixed number of rows (`EstimatorEntry::fit_passes`).
CostEstimate estimate_cost(const RunRequest& request, const Plan& plan,
                           const Calibration& calibration);

}  // namespace touchdown::experiments
