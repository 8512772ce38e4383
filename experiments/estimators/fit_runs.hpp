#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "recordings/models/provenance.hpp"
#include "scoring/transitions.hpp"

namespace touchdown::experiments {

struct RunSignals;

/// Labelled runs that a model is fitted to. They must outlive the fit.
struct FitRuns {
  std::vector<const RunSignals*> whole;
  /// Cut from other runs, for those that learn from pieces; there may be none.
  std::vector<const RunSignals*> pieces = {};
  scoring::ScoringConfig scoring = {};  ///< how much of the beginning of a whole run is not used
  /// Called before whatever takes long: what it throws ends the fit.
  std::function<void()> before_density = {};
};

double period_of(const RunSignals& run);

/// How many steps the first `skip` seconds of a run are, at most all of them.
std::size_t skipped_steps(const RunSignals& run, double skip);

/// What the estimator of this name was fitted to, each run without its first `skip` seconds:
/// scenarios, simulators, seeds, runs and seconds.
recordings::ModelProvenance provenance_of(std::string_view estimator,
                                          std::span<const RunSignals* const> runs, double skip);

}  // namespace touchdown::experiments
