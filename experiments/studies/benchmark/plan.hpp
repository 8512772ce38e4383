#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "experiments/plan/plan.hpp"
#include "experiments/studies/benchmark/config.hpp"

namespace touchdown::experiments {

/// A robot with its sensors, by their names in tables.
struct BenchmarkSetup {
  std::string robot;    ///< "upkie_heavy"; the experiment's own is that of its first scenario
  std::string sensors;  ///< "harsh", "ideal"
  RobotAndSensors robot_and_sensors;  ///< of its runs in the plan
  std::size_t group = 0;              ///< of its runs in the plan
};

/// Number of refits of the fit with this name.
int refits_of(const BenchmarkConfig& benchmark, const std::string& fit);

/// Every combination of a robot and sensors, the experiment's own first.
std::vector<BenchmarkSetup> benchmark_setups(const RunRequest& request, const Plan& plan);

inline constexpr std::string_view extended_measure = "extended";

/// Measures extended scores, of type `scoring::ExtendedScore`, of every prediction but those of
/// refits.
Measure extended_scores();

/// Adds runs for fitting and for testing, for every setup but the experiment's own. All test runs
/// are scored at the highlighted noise, with extended scores.
void add_benchmark(const RunRequest& request, Plan& plan);

}  // namespace touchdown::experiments
