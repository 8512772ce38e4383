#include "experiments/studies/sensor_sweep/plan.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/table.hpp"
#include "experiments/studies/sensor_sweep/config.hpp"
#include "noise/sensor_profile.hpp"

namespace touchdown::experiments {

namespace {

std::string name_of(const SensorVariation& variation) {
  return fmt::format("{}={}", variation.key, exact(variation.value));
}

}  // namespace

std::vector<SensorVariation> sensor_variations(const Experiment& experiment) {
  std::vector<SensorVariation> all;
  for (const SensorFactor& factor : experiment.studies.at<SensorSweepConfig>().factors) {
    for (const double value : factor.values) all.push_back({factor.key, value});
  }
  return all;
}

void add_sensor_sweep(const RunRequest& request, Plan& plan) {
  const Experiment& experiment = request.experiment;
  const noise::SensorProfile own = plan.sensors.front().profile;
  const std::size_t first = plan.runs.size();
  for (const SensorVariation& variation : sensor_variations(experiment)) {
    const std::string name = name_of(variation);
    plan.sensors.push_back({name, noise::with_value(own, variation.key, variation.value)});
    plan_runs(request, RunRole::test, {.sensors = plan.sensors.size() - 1}, plan.groups.size(),
              plan);
    plan.groups.push_back(
        {name, own_engine_conditions(experiment), {}, {experiment.highlights.front()}});
  }
  plan_tasks(experiment, first, plan);
}

std::size_t group_of(const SensorVariation& variation, const Plan& plan) {
  const std::string name = name_of(variation);
  const std::optional<std::size_t> group = plan.group_called(name);
  if (!group) throw Error(fmt::format("{} is not in the plan", name));
  return *group;
}

}  // namespace touchdown::experiments
