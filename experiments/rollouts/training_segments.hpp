#pragma once

#include <span>
#include <string>
#include <vector>

#include "experiments/rollouts/rollouts.hpp"

namespace touchdown::experiments {

/// The training segments of one fit on one engine: for every entry, one segment from each of the
/// first `runs` runs that did not fail. A segment has only the data that a fit needs.
std::vector<RunSignals> training_segments_of(const Rollouts& runs, const std::string& simulator,
                                             std::span<const TrainingSegments> segments,
                                             const std::string& fit = {});

}  // namespace touchdown::experiments
