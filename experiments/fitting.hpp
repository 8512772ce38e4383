#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "estimator/bayes_filter.hpp"
#include "estimator/phase_model.hpp"
#include "experiments/experiment.hpp"
#include "experiments/heard_run.hpp"
#include "recordings/phase_model_file.hpp"

namespace touchdown {

/// Torques of both legs, processed as the filter processes them, by the label of their wheel.
struct LabelledTorques {
  std::vector<TorqueSample> contact;
  std::vector<TorqueSample> no_contact;
};

/// From noiseless runs, without the first `scoring.skip` seconds of each.
LabelledTorques labelled_torques(std::span<const HeardRun* const> runs, const TorqueConfig& config,
                                 const ScoringConfig& scoring);

/// The measurement model that a configuration fits to noiseless runs, as in the paper's Section
/// III. Errors: `InputError` when the runs lack contact or flight.
MeasurementModel fit(std::span<const HeardRun* const> runs, const MeasurementConfig& config,
                     const ScoringConfig& scoring);

/// What an estimator was fitted with: one of the two.
struct FittedModel {
  std::optional<MeasurementModel> measurement;
  std::shared_ptr<const PhaseModelFile> phase;
};

/// Models by engine that was fitted on, then by estimator. Estimators that need the same model
/// share it.
using FittedModels = std::map<std::string, std::map<std::string, FittedModel>>;

/// Fits what the experiment's estimators need, for each engine on its own runs, in parallel.
/// `going_on` is asked before each density; false ends it with `Stopped`.
FittedModels fit_models(const Experiment& experiment, const std::vector<HeardRun>& fit_runs,
                        const std::function<bool()>& going_on = {});

}  // namespace touchdown
