#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "experiments/studies/benchmark/plan.hpp"
#include "experiments/studies/odometry/config.hpp"

namespace touchdown::experiments {

/// Measures of odometry: scores of type `scoring::TrajectoryScore`, and trajectories as TUM texts.
inline constexpr std::string_view odometry_measure = "odometry";
inline constexpr std::string_view trajectory_measure = "trajectories";

/// The setups of the odometry study: the experiment's own, and those of a benchmark.
std::vector<BenchmarkSetup> odometry_setups(const RunRequest& request, const Plan& plan);

/// Adds the scores to the test runs of these setups, with contact from the oracles, then
/// from each in-domain condition in the first scored noise setting.
void add_odometry_study(const RunRequest& request, Plan& plan);

/// The contact sources of odometry in one setup and engine, by their names in tables, in the order
/// of the scores of a run.
std::vector<std::string> contact_sources_of(const OdometryStudyConfig& config,
                                            const RunGroup& group, const std::string& simulator);

}  // namespace touchdown::experiments
