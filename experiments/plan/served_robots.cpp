#include "experiments/plan/served_robots.hpp"

#include <filesystem>
#include <set>
#include <string>
#include <tuple>

#include "experiments/config/experiment.hpp"
#include "scenarios/leg_geometry.hpp"

namespace touchdown::experiments {

EstimatorSetup robot_setup(const Experiment& experiment, const scenarios::Scenario& scenario,
                           scenarios::CompiledScenes& scenes) {
  return {.sample_rate = 1e6 / static_cast<double>(scenario.simulation.steps.control_us),
          .legs = scenarios::leg_geometry(*scenes.as_described(scenario)),
          .robot = std::filesystem::path(scenario.robot).stem().string(),
          .transfer = experiment.transfer};
}

void require_served(const Experiment& experiment, std::string_view estimator,
                    const scenarios::Scenario& scenario, scenarios::CompiledScenes& scenes) {
  const EstimatorEntry& entry = estimator_entry(experiment, estimator);
  if (entry.require_served == nullptr || experiment.transfer) return;
  entry.require_served(entry, robot_setup(experiment, scenario, scenes));
}

void require_served(const Experiment& experiment, const Plan& plan) {
  scenarios::CompiledScenes scenes;
  std::set<std::tuple<std::string, std::string, std::int64_t>> checked;
  for (const PlannedRun& run : plan.runs) {
    if (run.role != RunRole::test) continue;
    for (const Condition& condition : plan.groups[run.group].conditions) {
      const std::int64_t period = run.scenario.simulation.steps.control_us;
      if (!checked.insert({condition.estimator, run.scenario.robot, period}).second) continue;
      require_served(experiment, condition.estimator, run.scenario, scenes);
    }
  }
}

}  // namespace touchdown::experiments
