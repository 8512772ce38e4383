#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "experiments/phase_study_score.hpp"

namespace touchdown {

/// Runs [first, first + count) of a scenario, at 1 kHz, without those that fell.
Runs play_all(const std::string& file, const std::string& engine, std::uint64_t seed,
              std::int64_t first, int count);

/// Estimators by name, fitted on one engine's runs.
struct Fitted {
  std::map<std::string, Make> make;
  double seconds = 0.0;
};

/// Fits the phase filter to 1.9 s of each of so many stairs runs of an engine, 5 s of hanging and
/// 7 s of lifting, and the others to four whole stairs runs; the network comes as it is shipped.
/// Errors: `Error` for more than `most_seconds`.
Fitted fit_on(const std::string& engine, int stairs_runs, double most_seconds);

}  // namespace touchdown
