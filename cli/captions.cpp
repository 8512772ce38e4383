#include "cli/captions.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace touchdown {

std::string plural(std::size_t count, const std::string& thing) {
  return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

std::string labels_text(const Experiment& experiment) {
  return fmt::format("contact: normal force > {} N, states under {} ms merged",
                     experiment.labels.force_threshold, 1e3 * experiment.labels.debounce);
}

std::string scored_text(const ExperimentResult& result, const std::string& simulator) {
  const auto runs = scored_runs(result.runs);
  const auto scored = std::count_if(runs.begin(), runs.end(), [&](const HeardRun* run) {
    return run->info.simulator == simulator;
  });
  return fmt::format("{} × {}; {}", plural(static_cast<std::size_t>(scored), "test run"),
                     plural(static_cast<std::size_t>(result.experiment.noise.seeds), "noise seed"),
                     labels_text(result.experiment));
}

}  // namespace touchdown
