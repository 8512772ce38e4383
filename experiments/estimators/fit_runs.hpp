#pragma once

#include <cstddef>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "estimator/models/arrays.hpp"
#include "logs/recording.hpp"
#include "scoring/transitions.hpp"

namespace touchdown::experiments {

struct RunSignals;

/// Labelled runs to fit a model to. They must outlive the fit.
struct FitRuns {
  std::vector<const RunSignals*> whole;
  scoring::ScoringConfig scoring = {};  ///< its `skip` is the unused beginning of a whole run
};

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

/// The number of a run's steps in the first `skip` seconds of its log, at most all of them.
std::size_t skipped_steps(const RunSignals& run, double skip);

/// Of these runs, each without its first `skip` seconds.
FittedTo fitted_to(std::span<const RunSignals* const> runs, double skip);

}  // namespace touchdown::experiments
