#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/plan/plan.hpp"

namespace touchdown::experiments {

/// A run as the estimators of a benchmark hear it: one file of an export, one file of beliefs.
struct HeardRun {
  std::string name;   ///< of its file, without extension: "upkie/harsh/mujoco_stairs_test_003_…"
  std::string robot;  ///< as tables name it
  std::string sensors;  ///< likewise
  std::string scene;    ///< likewise
  std::size_t run = 0;  ///< index in the plan
  /// Of test runs: index in the plan's tasks, which says through which noise. Fitted ones are heard
  /// without any.
  std::optional<std::size_t> task = {};
  std::size_t cell = 0;  ///< index in the highlighted noise settings
};

/// Every run of a benchmark, by robot, sensors, role, engine, scene, number, noise. Errors:
/// `InputError` when the experiment is none, or a robot's or a profile's name cannot name a folder.
std::vector<HeardRun> exported_runs(const RunRequest& request, const Plan& plan);

/// Which part of it; an empty list is all.
struct BenchmarkPart {
  std::vector<std::string> robots;
  std::vector<std::string> sensors;
  std::vector<std::string> simulators;
};

/// Those of the part. Errors: `InputError` for a name that the benchmark does not have.
std::vector<HeardRun> part_of(const std::vector<HeardRun>& all, const BenchmarkPart& part,
                              const Plan& plan);

}  // namespace touchdown::experiments
