#pragma once

#include "experiments/studies/benchmark/plan.hpp"

namespace touchdown::experiments {

/// The robots and sensors with which odometry is studied: the experiment's own, and a benchmark's.
std::vector<BenchmarkSetup> odometry_settings(const RunRequest& request, const Plan& plan);

/// Their test runs are heard by odometry too.
void add_odometry_study(const RunRequest& request, Plan& plan);

/// Who tells odometry about contact in a setting, in the order of a task's scores: as tables name
/// them, on one engine.
std::vector<std::string> contact_sources_of(const RunGroup& group, const std::string& simulator);

}  // namespace touchdown::experiments
