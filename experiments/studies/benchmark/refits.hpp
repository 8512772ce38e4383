#pragma once

#include <cstdint>
#include <vector>

#include "experiments/signals/run_signals.hpp"

namespace touchdown::experiments {

/// As many runs, drawn from these with replacement, scene by scene and engine by engine, so that
/// none loses its place in the fit. The draw depends on the seed and its number alone.
std::vector<RunSignals> drawn_anew(const std::vector<RunSignals>& runs, std::uint64_t seed,
                                   int number);

}  // namespace touchdown::experiments
