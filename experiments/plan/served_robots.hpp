#pragma once

#include <string_view>

#include "experiments/estimators/entry.hpp"
#include "experiments/plan/plan.hpp"
#include "scenarios/engine.hpp"

namespace touchdown::experiments {

/// The robot of a scenario as estimators know it: its name, its legs as its file describes them,
/// and its rate.
EstimatorSetup robot_setup(const Experiment& experiment, const scenarios::Scenario& scenario,
                           scenarios::CompiledScenes& scenes);

/// Errors: `InputError` for an estimator with a shipped model that does not serve the robot or the
/// rate of a scenario, unless the experiment has `transfer`.
void require_served(const Experiment& experiment, std::string_view estimator,
                    const scenarios::Scenario& scenario, scenarios::CompiledScenes& scenes);

/// The same for all test runs of a plan, before one of them is simulated.
void require_served(const Experiment& experiment, const Plan& plan);

}  // namespace touchdown::experiments
