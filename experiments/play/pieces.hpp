#pragma once

#include <span>
#include <string>
#include <vector>

#include "experiments/play/play.hpp"

namespace touchdown::experiments {

/// The pieces of one engine's runs that one fit is made of: of every entry the first so many runs
/// that did not fail. A piece holds what a fit needs of its steps, and no more.
std::vector<RunSignals> pieces_of(const PlayedRuns& runs, const std::string& simulator,
                                  std::span<const FitPieces> pieces, const std::string& fit = {});

}  // namespace touchdown::experiments
