#include "experiments/studies/cross_simulator/variations.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/table.hpp"
#include "experiments/studies/cross_simulator/config.hpp"
#include "scenarios/perturbation.hpp"
#include "scenarios/scenario_file.hpp"

namespace touchdown::experiments {

namespace {

/// Adds the runs of one value, with the perturbations of the experiment's test runs.
void plan_runs(const RunRequest& request, const Variation& variation, Plan& plan) {
  const Experiment& experiment = request.experiment;
  const auto& config = experiment.studies.at<CrossSimulatorConfig>();
  const Factor& factor = config.factors[variation.factor_index];
  const NamedScenario& named = scenario_of(request, experiment.test.scenarios.front());
  try {
    const scenarios::Scenario scenario =
        scenarios::varied(named.scenario, factor.key, variation.value, named.file);
    for (int i = 0; i < config.sensitivity_runs; ++i) {
      plan.runs.push_back(
          {.role = RunRole::test,
           .simulator = variation.simulator,
           .scenario = experiment.test.perturbed
                           ? scenarios::perturbed(scenario, experiment.seed, i)
                           : scenario,
           .run = i,
           .file = fmt::format("{}_{}_factor_{}_{}_{:03}.mpack", variation.simulator, scenario.name,
                               variation.factor_index, exact(variation.value), i),
           .seed = experiment.seed,
           .group = plan.groups.size()});
    }
  } catch (const InputError& error) {
    throw InputError(fmt::format("cross_simulator.sensitivity.factors.{}: {}={}: {}",
                                 variation.factor_index, factor.key, exact(variation.value),
                                 error.what()));
  }
}

std::string group_name(const Variation& variation) {
  return fmt::format("factor {} {} {}", variation.factor_index, exact(variation.value),
                     variation.simulator);
}

}  // namespace

std::vector<Variation> variations(const RunRequest& request) {
  const Experiment& experiment = request.experiment;
  const NamedScenario& named = scenario_of(request, experiment.test.scenarios.front());
  std::vector<Variation> all;
  const std::vector<Factor>& factors = experiment.studies.at<CrossSimulatorConfig>().factors;
  for (std::size_t f = 0; f < factors.size(); ++f) {
    const double nominal = scenarios::number_at(named.scenario, factors[f].key);
    if (std::isnan(nominal)) {
      throw InputError(fmt::format("cross_simulator.sensitivity.factors.{}: {} has no number at {}",
                                   f, named.file, factors[f].key));
    }
    std::set<double> values(factors[f].values.begin(), factors[f].values.end());
    values.insert(nominal);
    for (const std::string& simulator : factors[f].simulators) {
      for (const double value : values) {
        all.push_back({f, factors[f].name, value, nominal, simulator});
      }
    }
  }
  return all;
}

void add_cross_simulator(const RunRequest& request, Plan& plan) {
  const Experiment& experiment = request.experiment;
  RunGroup& own = plan.groups.front();
  for (const Condition& condition : transfer_conditions(experiment)) {
    if (!condition.is_fitted_in_domain()) own.conditions.push_back(condition);
  }
  const std::size_t first = plan.runs.size();
  for (const Variation& variation : variations(request)) {
    if (variation.is_nominal()) continue;
    plan_runs(request, variation, plan);
    plan.groups.push_back({group_name(variation),
                           tested_on(own_engine_conditions(experiment), variation.simulator),
                           {experiment.highlights.front()},
                           {}});
  }
  plan_tasks(experiment, first, plan);
}

std::vector<std::size_t> runs_of(const Variation& variation, const RunRequest& request,
                                 const Plan& plan) {
  if (const auto group = plan.group_called(group_name(variation))) return plan.runs_in(*group);
  std::vector<std::size_t> runs = plan.runs_in(0);
  std::erase_if(runs,
                [&](std::size_t run) { return plan.runs[run].simulator != variation.simulator; });
  runs.resize(static_cast<std::size_t>(
      request.experiment.studies.at<CrossSimulatorConfig>().sensitivity_runs));
  return runs;
}

}  // namespace touchdown::experiments
