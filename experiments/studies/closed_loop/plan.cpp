#include "experiments/studies/closed_loop/plan.hpp"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/table.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/estimators/registry.hpp"
#include "scenarios/scenario_file.hpp"
#include "experiments/plan/plan.hpp"

namespace touchdown::experiments {

namespace {

/// The points of a scene. At most one of values, noise and delay has more than one entry.
std::vector<ClosedLoopCell> points(const ClosedLoopScene& scene, ClosedLoopCell cell) {
  std::vector<double> values = scene.values;
  if (values.empty()) values = {std::numeric_limits<double>::quiet_NaN()};
  std::vector<ClosedLoopCell> cells;
  for (const double value : values) {
    for (const noise::NoiseCell& noise : scene.noise) {
      for (const double delay : scene.delay) {
        cell.point = cells.size();
        cell.value = value;
        cell.noise = noise;
        cell.delay = delay;
        cells.push_back(cell);
      }
    }
  }
  return cells;
}

}  // namespace

std::vector<ClosedLoopCell> closed_loop_cells(const Experiment& experiment) {
  std::vector<ClosedLoopCell> cells;
  const auto* const section = experiment.studies.find<ClosedLoopConfig>();
  if (section == nullptr) return cells;
  const ClosedLoopConfig& config = *section;
  for (std::size_t scene = 0; scene < config.scenes.size(); ++scene) {
    for (const std::string& simulator : experiment.simulators) {
      for (const std::string& law : config.laws) {
        for (const std::string& contact : config.contact) {
          const std::vector<ClosedLoopCell> of_curve =
              points(config.scenes[scene],
                     {.simulator = simulator, .law = law, .contact = contact, .scene = scene});
          cells.insert(cells.end(), of_curve.begin(), of_curve.end());
        }
      }
    }
  }
  return cells;
}

std::size_t closed_loop_runs(const Experiment& experiment) {
  const auto* const config = experiment.studies.find<ClosedLoopConfig>();
  if (config == nullptr) return 0;
  return closed_loop_cells(experiment).size() * static_cast<std::size_t>(config->runs);
}

scenarios::Scenario scenario_of(const RunRequest& request, const ClosedLoopCell& cell) {
  const ClosedLoopScene& scene =
      request.experiment.studies.at<ClosedLoopConfig>().scenes[cell.scene];
  const NamedScenario& named = scenario_of(request, scene.scenario);
  scenarios::Scenario scenario = named.scenario;
  try {
    if (!scene.key.empty()) {
      if (std::isnan(scenarios::number_at(scenario, scene.key))) {
        throw InputError(fmt::format("{} has no number there", named.file));
      }
      scenario = scenarios::varied(scenario, scene.key, cell.value, named.file);
    }
  } catch (const InputError& error) {
    throw InputError(fmt::format("closed_loop.scenes.{}: {}={}: {}", cell.scene, scene.key,
                                 exact(cell.value), error.what()));
  }
  using Law = policies::PolicyConfig::Law;
  scenario.policy = {.law = cell.law == "balancer" ? Law::balancer : Law::soft_landing,
                     .contact = cell.contact,
                     .delay = cell.delay};
  return scenario;
}

void require_closed_loop(const RunRequest& request) {
  const Experiment& experiment = request.experiment;
  const auto* const config = experiment.studies.find<ClosedLoopConfig>();
  if (config == nullptr) return;
  const std::int64_t period =
      scenario_of(request, experiment.test.scenarios.front()).scenario.simulation.steps.control_us;
  scenarios::CompiledScenes scenes;
  for (const ClosedLoopCell& cell : closed_loop_cells(experiment)) {
    const ClosedLoopScene& scene = config->scenes[cell.scene];
    if (scenario_of(request, cell).simulation.steps.control_us != period) {
      throw InputError(fmt::format(
          "closed_loop.scenes.{}: {} has another control period than the test runs, for which "
          "estimators are fitted",
          cell.scene, scene.scenario));
    }
    const bool is_estimator = !cell.is_oracle() && cell.contact != "always";
    if (is_estimator && estimator_entry(experiment, cell.contact).make == nullptr) {
      throw InputError(fmt::format(
          "closed_loop.contact: '{}' needs whole runs, but a policy gets contact step by step",
          cell.contact));
    }
    if (is_estimator) {
      require_served(experiment, cell.contact, scenario_of(request, cell), scenes);
    }
  }
}

std::string varied_quantity(const ClosedLoopScene& scene) {
  if (scene.values.size() > 1) return scene.key.substr(scene.key.rfind('.') + 1);
  if (scene.delay.size() > 1) return "delay";
  return scene.noise.size() > 1 ? "noise" : "";
}

}  // namespace touchdown::experiments
