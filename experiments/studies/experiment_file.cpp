#include "experiments/studies/experiment_file.hpp"

#include <utility>

#include "experiments/studies/registry.hpp"

namespace touchdown::experiments {

Experiment experiment_from_yaml(const YamlDocument& document,
                                std::vector<EstimatorEntry> external_estimators) {
  return experiment_from_yaml(document, study_sections(), std::move(external_estimators));
}

std::vector<Key> experiment_keys() { return experiment_keys(study_sections()); }

void require_files(const YamlDocument& document) { require_files(document, study_sections()); }

RunRequest read_request(const std::filesystem::path& run_directory) {
  return read_request(run_directory, study_sections());
}

}  // namespace touchdown::experiments
