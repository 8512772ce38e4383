#pragma once

#include <filesystem>
#include <vector>

#include "experiments/config/experiment_yaml.hpp"
#include "experiments/plan/request.hpp"

namespace touchdown::experiments {

// Experiment files with the sections of all studies; otherwise as in experiments/config and
// experiments/plan.

Experiment experiment_from_yaml(const YamlDocument& document,
                                std::vector<EstimatorEntry> external_estimators = {});
std::vector<Key> experiment_keys();
void require_files(const YamlDocument& document);
RunRequest read_request(const std::filesystem::path& run_directory);

}  // namespace touchdown::experiments
