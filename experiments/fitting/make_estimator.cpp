#include "experiments/fitting/make_estimator.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "experiments/config/experiment.hpp"

namespace touchdown::experiments {

EstimatorEntry entry_of(const Experiment& experiment, const Condition& condition,
                        const FittedModels& models) {
  const EstimatorEntry& entry = estimator_entry(experiment, condition.estimator);
  if (entry.hyperparameters.empty()) return entry;
  const auto fit = models.find(model_key(condition.fit_simulator, condition.fit, condition.refit));
  if (fit == models.end()) return entry;
  const auto model = fit->second.find(condition.estimator);
  return model == fit->second.end() ? entry
                                    : with_hyperparameters(entry, model->second.hyperparameters);
}

EstimatorSetup setup_of(const Experiment& experiment, const Condition& condition,
                        const FittedModels& models, const RunSignals& run) {
  const FittedModel* model =
      estimator_entry(experiment, condition.estimator).fits()
          ? &models.at(model_key(condition.fit_simulator, condition.fit, condition.refit))
                 .at(condition.estimator)
          : nullptr;
  return {1e6 / static_cast<double>(run.info.control_period_us),
          model,
          run.legs,
          &run.contact,
          robot_of(run.info),
          experiment.transfer};
}

std::unique_ptr<ContactEstimator> make_estimator(const Experiment& experiment,
                                                 const Condition& condition,
                                                 const FittedModels& models,
                                                 const RunSignals& run) {
  const EstimatorEntry entry = entry_of(experiment, condition, models);
  if (entry.make == nullptr) {
    throw InputError(fmt::format("'{}' processes whole runs, and this use needs one step at a time",
                                 entry.name));
  }
  return entry.make(entry, setup_of(experiment, condition, models, run));
}

EstimatorRunner runner_of(const Experiment& experiment, const Condition& condition,
                          const FittedModels& models, const RunSignals& run) {
  return runner_of(entry_of(experiment, condition, models),
                   setup_of(experiment, condition, models, run));
}

}  // namespace touchdown::experiments
