#pragma once

#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "estimator/bayes/config.hpp"
#include "estimator/bayes/measurement_model.hpp"
#include "estimator/models/arrays.hpp"
#include "logs/recording.hpp"

namespace touchdown::experiments {

struct RunSignals;

/// Labelled runs to fit a model to.
using FitRuns = std::span<const RunSignals* const>;

/// Fits the measurement model of a configuration to noiseless runs, each without its first `skip`
/// seconds, as in the paper's Section III.
/// Errors: `InputError` when the runs lack contact or flight.
MeasurementModel fit_torques(FitRuns runs, double skip, const MeasurementConfig& config);

/// The path of a simulated log's robot; empty for other logs.
std::filesystem::path robot_file_of(const logs::RecordingInfo& log);

/// The name of the robot's file, without extension; empty for a log that does not name it.
std::string robot_of(const logs::RecordingInfo& info);

/// What a model's metadata and its array `provenance` record about the runs of its fit.
struct FittedTo {
  double sample_rate = 0.0;  ///< of the first run (Hz)
  double seconds = 0.0;      ///< without skipped parts
  std::set<std::string> robots = {}, scenarios = {}, simulators = {};
  std::set<std::string> draws = {};  ///< "seed:run" of simulated runs
  std::set<std::string> logs = {};   ///< digests of logs' signals

  void add(const logs::RecordingInfo& info);
  /// "key: value" lines. Python reads them by `bytes(npz["provenance"].astype("u1")).decode()`.
  ModelArray provenance(std::string_view estimator) const;
};

/// Of these runs, each without the first `skip` seconds of its log.
FittedTo fitted_to(FitRuns runs, double skip);

}  // namespace touchdown::experiments
