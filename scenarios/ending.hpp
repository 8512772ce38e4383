#pragma once

#include <string>

#include "recordings/recording.hpp"
#include "scenarios/scenario.hpp"

namespace touchdown::scenarios {

/// An outcome in running text: "timed out", "left the terrain".
std::string outcome_text(recordings::Outcome outcome);

/// How and when a run ended, and why if it ended early: "finished after 27.552 s", "fell after
/// 1.048 s: pitch beyond 1 rad". `end` holds the limits of the run's scenario.
std::string ending_text(const recordings::Recording& recording, const End& end);

}  // namespace touchdown::scenarios
