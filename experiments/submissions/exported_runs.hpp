#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/plan/plan.hpp"

namespace touchdown::experiments {

/// A run of a benchmark as the input of an estimator: one file of an export, one file of beliefs.
struct ExportedRun {
  std::string name;   ///< of its file, without extension: "upkie/harsh/mujoco_stairs_test_003_…"
  std::string robot;  ///< by its name in tables
  std::string sensors;  ///< likewise
  std::string scene;    ///< likewise
  std::size_t run = 0;  ///< index in the plan
  /// For test runs: index in the plan's tasks, which specify the noise. Runs for fitting have no
  /// noise.
  std::optional<std::size_t> task = {};
  std::size_t cell = 0;  ///< index in the highlighted noise settings
};

/// Every run of a benchmark, by robot, sensors, role, engine, scene, number, noise. Errors:
/// `InputError` when the experiment is no benchmark, or when the name of a robot or a sensor
/// profile cannot name a folder.
std::vector<ExportedRun> exported_runs(const RunRequest& request, const Plan& plan);

/// A part of a benchmark; an empty list selects all.
struct BenchmarkPart {
  std::vector<std::string> robots;
  std::vector<std::string> sensors;
  std::vector<std::string> simulators;
};

/// The runs of the part. Errors: `InputError` for a name that the benchmark does not have.
std::vector<ExportedRun> part_of(const std::vector<ExportedRun>& all, const BenchmarkPart& part,
                                 const Plan& plan);

}  // namespace touchdown::experiments
