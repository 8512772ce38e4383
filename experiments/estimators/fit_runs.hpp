#pragma once

#include <cstddef>
#include <functional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "estimator/force/leg_geometry.hpp"
#include "estimator/models/arrays.hpp"
#include "logs/recording.hpp"
#include "scoring/transitions.hpp"

namespace touchdown::experiments {

struct RunSignals;

/// Labelled runs to fit a model to. They must outlive the fit.
struct FitRuns {
  std::vector<const RunSignals*> whole;
  /// Segments of other runs, for estimators that learn from training segments; may be empty.
  std::vector<const RunSignals*> segments = {};
  scoring::ScoringConfig scoring = {};  ///< its `skip` is the unused beginning of a whole run
  /// Called before each long computation. An exception from it ends the fit.
  std::function<void()> before_density = {};
  /// Whether models that can have the load by the servo law get it (`DecisionConfig`).
  bool servo_load = false;

  /// Whole runs and segments together as whole runs, for estimators that use all data alike.
  [[nodiscard]] FitRuns together() const;
};

/// Legs of the robot, which all runs of one fit share.
LegGeometry legs_of(const FitRuns& runs);

/// The name of the robot's file, without extension; empty for a log that does not name it.
std::string robot_of(const logs::RecordingInfo& info);

/// The data that a model's metadata records about the runs of its fit.
struct FittedTo {
  double sample_rate = 0.0;  ///< of the first run (Hz)
  std::set<std::string> robots;
  LegGeometry legs = {};
  bool servo_load = false;  ///< as in `FitRuns`

  void add(const logs::RecordingInfo& info);
};

/// The number of a run's steps in the first `skip` seconds of its log, at most all of them.
std::size_t skipped_steps(const RunSignals& run, double skip);

/// The array `provenance` of a fit of this estimator, "key: value" lines: scenarios, simulators,
/// seeds, runs and seconds. Each run counts without its first `skip` seconds. Python reads it by
/// `bytes(npz["provenance"].astype("u1")).decode()`.
ModelArray provenance_of(std::string_view estimator, std::span<const RunSignals* const> runs,
                         double skip);

}  // namespace touchdown::experiments
