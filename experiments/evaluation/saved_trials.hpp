#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scoring/classification.hpp"

namespace touchdown::experiments {

/// Point-wise counts of one trial, by noise setting and scene.
using SceneCounts = std::map<std::string, scoring::Classification>;

/// The saved counts of trials, by fold. An interrupted run, or a merge of shards, reuses them.
class SavedTrials {
 public:
  SavedTrials() = default;  ///< saves nothing
  /// `key` identifies the experiment and the build. Files with another key are ignored.
  SavedTrials(std::filesystem::path folder, std::string key);

  /// By trial.
  std::optional<std::vector<SceneCounts>> read(const std::string& name) const;
  void write(const std::string& name, const std::vector<SceneCounts>& trials) const;

 private:
  std::filesystem::path folder_;
  std::string key_;
};

}  // namespace touchdown::experiments
