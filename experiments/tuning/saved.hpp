#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scoring/classification.hpp"

namespace touchdown::experiments {

/// What was counted of one trial, by scene and noise setting.
using PlaceCounts = std::map<std::string, scoring::Classification>;

/// Where it is saved what trials made of a fold: an interrupted run, and whoever merges shards,
/// need not try again.
class SavedTrials {
 public:
  SavedTrials() = default;  ///< nowhere
  /// `key` names the experiment and the build: nothing else is believed.
  SavedTrials(std::filesystem::path folder, std::string key);

  /// By trial.
  std::optional<std::vector<PlaceCounts>> read(const std::string& name) const;
  void write(const std::string& name, const std::vector<PlaceCounts>& trials) const;

 private:
  std::filesystem::path folder_;
  std::string key_;
};

}  // namespace touchdown::experiments
