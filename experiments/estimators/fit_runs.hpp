#pragma once

#include <cstddef>
#include <functional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "estimator/force/leg_geometry.hpp"
#include "recordings/models/provenance.hpp"
#include "recordings/recording.hpp"
#include "scoring/transitions.hpp"

namespace touchdown::experiments {

struct RunSignals;

/// Labelled runs that a model is fitted to. They must outlive the fit.
struct FitRuns {
  std::vector<const RunSignals*> whole;
  /// Cut from other runs, for those that learn from pieces; there may be none.
  std::vector<const RunSignals*> segments = {};
  scoring::ScoringConfig scoring = {};  ///< how much of the beginning of a whole run is not used
  /// Called before whatever takes long: what it throws ends the fit.
  std::function<void()> before_density = {};

  /// Whole runs and pieces alike as whole runs, for those that decide better what they see more of.
  [[nodiscard]] FitRuns together() const;
};

/// Of the robot that is fitted to, which runs that are fitted together share.
LegGeometry legs_of(const FitRuns& runs);

double period_of(const RunSignals& run);

/// The robot of a run, as its file is called; empty for a log that does not say.
std::string robot_of(const recordings::RecordingInfo& info);

/// What a passport says of runs that a model was fitted to.
struct FittedTo {
  double sample_rate = 0.0;  ///< of the first of them (Hz)
  std::set<std::string> robots;
  LegGeometry legs = {};

  void add(const recordings::RecordingInfo& info);
};

/// How many steps the first `skip` seconds of a run are, at most all of them.
std::size_t skipped_steps(const RunSignals& run, double skip);

/// What the estimator of this name was fitted to, each run without its first `skip` seconds:
/// scenarios, simulators, seeds, runs and seconds.
recordings::ModelProvenance provenance_of(std::string_view estimator,
                                          std::span<const RunSignals* const> runs, double skip);

}  // namespace touchdown::experiments
