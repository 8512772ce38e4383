#pragma once

#include "experiments/studies/benchmark/plan.hpp"

namespace touchdown::experiments {

/// The setups of the odometry study: the experiment's own, and those of a benchmark.
std::vector<BenchmarkSetup> odometry_setups(const RunRequest& request, const Plan& plan);

/// Adds odometry to the test runs of these setups.
void add_odometry_study(const RunRequest& request, Plan& plan);

/// The contact sources of odometry in one setup and engine, by their names in tables, in the order
/// of a task's scores.
std::vector<std::string> contact_sources_of(const RunGroup& group, const std::string& simulator);

}  // namespace touchdown::experiments
