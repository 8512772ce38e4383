#pragma once

#include <cstddef>
#include <string>

#include "experiments/run_experiment.hpp"

namespace touchdown {

/// "1 run", "2 runs".
std::string plural(std::size_t count, const std::string& thing);
/// When a wheel counts as in contact: "contact: normal force > 1 N, states under 5 ms merged".
std::string labels_text(const Experiment& experiment);
/// What stands behind one engine's scores: "40 test runs × 1 noise seed; contact: ...".
std::string scored_text(const ExperimentResult& result, const std::string& simulator);

}  // namespace touchdown
