#pragma once

#include <span>
#include <string>
#include <vector>

#include "experiments/rollouts/rollouts.hpp"

namespace touchdown::experiments {

/// The pieces of one engine's runs that one fit is made of: of every entry the first so many runs
/// that did not fail. A piece holds what a fit needs of its steps, and no more.
std::vector<RunSignals> training_segments_of(const Rollouts& runs, const std::string& simulator,
                                  std::span<const TrainingSegments> segments, const std::string& fit = {});

}  // namespace touchdown::experiments
