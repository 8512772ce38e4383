#include "experiments/evaluation/saved_trials.hpp"

#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "experiments/run_directory/saved_state.hpp"

namespace touchdown::experiments {

SavedTrials::SavedTrials(std::filesystem::path folder, std::string key)
    : folder_(std::move(folder)), key_(std::move(key)) {}

std::optional<std::vector<SceneCounts>> SavedTrials::read(const std::string& name) const {
  if (folder_.empty()) return std::nullopt;
  const std::optional<std::string> text =
      read_state(folder_ / name, fmt::format("{} trials {}", key_, name));
  if (!text) return std::nullopt;
  std::istringstream lines(*text);
  std::size_t count = 0;
  lines >> count;
  std::vector<SceneCounts> trials(count);
  std::size_t trial = 0;
  std::string scene;
  scoring::Classification points;
  while (lines >> trial >> points.contact_as_contact >> points.contact_as_flight >>
             points.flight_as_contact >> points.flight_as_flight &&
         std::getline(lines >> std::ws, scene)) {
    trials.at(trial)[scene] = points;
  }
  return trials;
}

void SavedTrials::write(const std::string& name, const std::vector<SceneCounts>& trials) const {
  if (folder_.empty()) return;
  std::string text = fmt::format("{}\n", trials.size());
  for (std::size_t trial = 0; trial < trials.size(); ++trial) {
    for (const auto& [scene, points] : trials[trial]) {
      text += fmt::format("{} {} {} {} {} {}\n", trial, points.contact_as_contact,
                          points.contact_as_flight, points.flight_as_contact,
                          points.flight_as_flight, scene);
    }
  }
  write_state(folder_ / name, fmt::format("{} trials {}", key_, name), text);
}

}  // namespace touchdown::experiments
