#include "experiments/config/experiment.hpp"

#include <functional>

#include "core/rows.hpp"
#include "experiments/estimators/registry.hpp"

namespace touchdown::experiments {

std::vector<std::string> estimator_names(const Experiment& experiment) {
  return estimator_names(experiment.external_estimators);
}

const EstimatorEntry& estimator_entry(const Experiment& experiment, std::string_view name) {
  return estimator_entry(name, experiment.external_estimators);
}

ExperimentFiles files_of(const Experiment& experiment) {
  ExperimentFiles all{.scenarios = experiment.fit.scenarios, .robots = {""}};
  const auto append = [](auto& files, const auto& more) {
    files.insert(files.end(), more.begin(), more.end());
  };
  append(all.scenarios, experiment.test.scenarios);
  std::vector<std::string> sensors = {experiment.sensors};
  for (const StudySection& study : study_sections()) {
    if (!study.files) continue;
    const ExperimentFiles more = study.files(experiment);
    append(all.scenarios, more.scenarios);
    append(all.robots, more.robots);
    append(sensors, more.sensors);
  }
  all.sensors = unique(sensors, std::identity());
  std::erase(all.sensors, "");
  return all;
}

}  // namespace touchdown::experiments
