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

/// Fits every estimator of the study to so many stairs runs of an engine, some hanging and some
/// lifting; the network comes as it is shipped. Errors: `Error` for more than `most_seconds`.
Fitted fit_on(const std::string& engine, int stairs_runs, double most_seconds);

}  // namespace touchdown
