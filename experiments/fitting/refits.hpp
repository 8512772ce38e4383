#pragma once

#include <cstdint>

#include "experiments/signals/run_signals.hpp"

namespace touchdown::experiments {

/// Draws as many runs from these with replacement, within each scene and engine, so that every
/// scene and engine keeps its number of runs. Where every scene of an engine has one run, as drawn
/// scenes have, scenes are drawn. The draw depends only on `seed` and `number`.
RunPointers drawn_anew(const RunPointers& runs, std::uint64_t seed, int number);

}  // namespace touchdown::experiments
