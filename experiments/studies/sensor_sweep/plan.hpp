#pragma once

#include <string>
#include <vector>

#include "experiments/plan/plan.hpp"

namespace touchdown::experiments {

/// One value of one disturbance of the sensors.
struct SensorVariation {
  std::string key;
  double value = 0.0;
};

/// Every value of every disturbance, in the order of the file.
std::vector<SensorVariation> sensor_variations(const Experiment& experiment);

/// Adds, for every value, the experiment's own test runs with that value in their sensors, at the
/// first highlighted noise setting. Estimators keep the experiment's own fit. No run is simulated
/// again.
void add_sensor_sweep(const RunRequest& request, Plan& plan);

/// The group of a value's runs. Errors: `Error` if the plan has none.
std::size_t group_of(const SensorVariation& variation, const Plan& plan);

}  // namespace touchdown::experiments
