#pragma once

#include <string>
#include <vector>

#include "experiments/plan/plan.hpp"

namespace touchdown::experiments {

/// A robot and its sensors, as tables name them.
struct BenchmarkSetup {
  std::string robot;    ///< "upkie_heavy"; of the experiment's own: of its first scenario
  std::string sensors;  ///< "harsh", "ideal"
  RobotAndSensors setting;      ///< of its runs; its sensors are those of the plan
  std::size_t group = 0;
};

/// How often the fit of this name is repeated.
int refits_of(const BenchmarkConfig& benchmark, const std::string& fit);

/// Every combination of a robot and sensors, the experiment's own first.
std::vector<BenchmarkSetup> benchmark_settings(const RunRequest& request, const Plan& plan);

/// Adds, for every setting but the experiment's own, runs to fit to and runs to test on; all of
/// them are scored at the highlighted noise, and looked at closely.
void add_benchmark(const RunRequest& request, Plan& plan);

}  // namespace touchdown::experiments
