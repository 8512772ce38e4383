#include "experiments/config/experiment.hpp"

#include <algorithm>

#include "experiments/estimators/registry.hpp"

namespace touchdown::experiments {

std::vector<std::string> estimator_names(const Experiment& experiment) {
  return estimator_names(experiment.external_estimators);
}

const EstimatorEntry& estimator_entry(const Experiment& experiment, std::string_view name) {
  return estimator_entry(name, experiment.external_estimators);
}

static std::vector<StudyFiles> study_files(const Experiment& experiment) {
  std::vector<StudyFiles> files;
  for (const StudySection& study : study_sections()) {
    if (study.files) files.push_back(study.files(experiment));
  }
  return files;
}

std::vector<std::string> scenario_files(const Experiment& experiment) {
  std::vector<std::string> files = experiment.fit.scenarios;
  files.insert(files.end(), experiment.test.scenarios.begin(), experiment.test.scenarios.end());
  for (const TrainingSegments& segments : experiment.training_segments) {
    files.push_back(segments.scenario);
  }
  for (const StudyFiles& more : study_files(experiment)) {
    files.insert(files.end(), more.scenarios.begin(), more.scenarios.end());
  }
  return files;
}

std::vector<std::string> robot_files(const Experiment& experiment) {
  std::vector<std::string> files = {""};
  for (const StudyFiles& more : study_files(experiment)) {
    files.insert(files.end(), more.robots.begin(), more.robots.end());
  }
  return files;
}

std::vector<std::string> sensor_files(const Experiment& experiment) {
  std::vector<std::string> files;
  const auto add = [&](const std::string& file) {
    if (!file.empty() && std::find(files.begin(), files.end(), file) == files.end()) {
      files.push_back(file);
    }
  };
  add(experiment.sensors);
  for (const StudyFiles& more : study_files(experiment)) {
    for (const std::string& file : more.sensors) add(file);
  }
  return files;
}

}  // namespace touchdown::experiments
