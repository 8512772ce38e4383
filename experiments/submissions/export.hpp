#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "estimator/npz/npz.hpp"
#include "experiments/experiment_context.hpp"
#include "experiments/plan/plan.hpp"
#include "experiments/plan/rollouts.hpp"
#include "experiments/signals/run_signals.hpp"

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

/// Which part of a benchmark is exported, and where to.
struct ExportRequest {
  std::filesystem::path source;  ///< an experiment file, or a run directory
  std::filesystem::path folder;
  BenchmarkPart part;
};

struct ExportReport {
  std::size_t files = 0;            ///< files of signals
  std::uintmax_t bytes = 0;         ///< of these files
  std::vector<std::string> failed;  ///< recordings of failed runs, which are not exported
};

/// A table for the user: the number of files and their largest size, by robot, sensors and engine.
/// Computes and writes nothing. Errors: those of `export_benchmark` about the request.
std::string export_outline(const ExportRequest& request);

/// Writes the sensor signals of a benchmark into a new or an empty folder, for submitted
/// estimators, with `README.md`, `index.csv` and `SHA256SUMS`: all files or none. Equal runs give
/// equal bytes. Reads the runs that the run directory has recordings of, and simulates all others.
/// Errors: `InputError` for a wrong request, or a folder that is not empty; `Error` for too little
/// disk space; `Stopped`.
ExportReport export_benchmark(const ExportRequest& request, const RunOptions& options);

// The contents of the files:

/// SHA-256 (FIPS 180-4) of bytes, as `sha256sum` prints it: 64 hexadecimal digits.
std::string sha256(std::string_view bytes);

/// The README of an export: its arrays, the format of a submission, and the scoring.
std::string readme_of(const RunRequest& request);

/// The arrays of a run for fitting, one row per step: `time`, `has_record`, the members of
/// `Signals` and the labels `contact` (left, right). Joints have six columns: hip, knee, wheel of
/// the left leg, then of the right leg. At steps with a record the values equal the input of
/// `ContactEstimator::update` bit for bit. At other steps the time is that of the step.
ModelArrays exported_arrays(const RunSignals& run);

/// The arrays of a run with noise.
ModelArrays exported_arrays(const RunSignals& run, const NoiseRun& noise,
                            const noise::SensorNoise& levels);

/// Upper bound of the size of a run's arrays on disk (bytes).
double bytes_of_exported(double steps);

}  // namespace touchdown::experiments
