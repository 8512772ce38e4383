#include "experiments/config/experiment_estimators.hpp"

#include "experiments/estimators/registry.hpp"

namespace touchdown::experiments {

std::vector<std::string> estimator_names(const Experiment& experiment) {
  return estimator_names(experiment.external_estimators);
}

const EstimatorEntry& estimator_entry(const Experiment& experiment, std::string_view name) {
  return estimator_entry(name, experiment.external_estimators);
}

KeyNotes own_estimators(Fields& fields, std::string_view key, const Experiment& experiment,
                        std::vector<std::string>& names) {
  return fields.names(key, experiment.estimators, names)
      .type("list of the experiment's estimators");
}

}  // namespace touchdown::experiments
