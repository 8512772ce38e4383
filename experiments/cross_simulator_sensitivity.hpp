#pragma once

#include <string>
#include <vector>

#include "experiments/cross_simulator_config.hpp"
#include "experiments/run_plan.hpp"
#include "experiments/sweep.hpp"

namespace touchdown {

/// The runs of one value of one factor in one engine.
struct Variation {
  std::string factor;
  double value = 0.0;
  double nominal = 0.0;
  std::string simulator;
  std::vector<PlannedRun> plan;  ///< empty for the nominal value: those runs exist already
};

/// Every value of every factor, nominal ones included, in each engine where it means something. The
/// runs draw the same perturbations as the experiment's test runs.
/// Errors: `InputError` naming the factor when a scenario has no such key or refuses the value.
std::vector<Variation> plan_variations(const CrossSimulator& config,
                                       const std::vector<NamedScenario>& scenarios);

/// How an estimator that was fitted on the nominal scene does in a varied one.
struct Sensitivity {
  std::string factor;
  double value = 0.0;
  double nominal = 0.0;
  std::string simulator;
  std::string estimator;
  std::size_t runs = 0;    ///< that are scored
  std::size_t failed = 0;  ///< that fell or diverged
  Interval success;        ///< NaN when no run is left
};

/// Listens to the runs of one variation at the experiment's first highlighted noise setting.
std::vector<Sensitivity> sensitivity(const Experiment& experiment, const Variation& variation,
                                     const std::vector<const PlayedRun*>& runs,
                                     const FittedModels& models, const SweepProgress& progress);

}  // namespace touchdown
