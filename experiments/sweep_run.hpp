#pragma once

#include <functional>
#include <span>
#include <vector>

#include "experiments/classification.hpp"
#include "experiments/fitting.hpp"
#include "experiments/heard_run.hpp"
#include "experiments/sweep.hpp"

namespace touchdown {

/// Asked now and then; false stops the work with `Stopped`.
using GoingOn = std::function<bool()>;

/// Point-wise counts of one run heard through one noise realisation, both wheels added: by
/// condition, then cell, then piece of the run (`HeardRun::pieces`). Estimators that can listen to
/// many noise levels side by side do; what an estimator does not hear costs nothing.
/// Errors: `Stopped`.
std::vector<Classification> sweep_run(std::span<const Condition> conditions,
                                      std::span<const NoiseCell> cells, const HeardRun& run,
                                      const UnitNoise& noise, const FittedModels& models,
                                      const ScoringConfig& scoring, const GoingOn& going_on);

/// The same, one estimator and one cell after the other: what the above has to equal.
std::vector<Classification> sweep_run_one_by_one(std::span<const Condition> conditions,
                                                 std::span<const NoiseCell> cells,
                                                 const HeardRun& run, const UnitNoise& noise,
                                                 const FittedModels& models,
                                                 const ScoringConfig& scoring,
                                                 const GoingOn& going_on);

}  // namespace touchdown
