#pragma once

#include <functional>
#include <span>

#include "estimator/labelled_run.hpp"
#include "estimator/models/configuration.hpp"
#include "experiments/estimators/entry.hpp"

namespace touchdown::experiments {

/// What an estimator learns from labelled runs, by name.
using FitParameters = std::function<recordings::Parameters(std::span<const LabelledRun> runs)>;

/// The model of an entry that is fitted to parameters of its own: to whole runs, each without its
/// beginning, with where it comes from. Errors: `InputError` for runs of reserved seeds, and what
/// `fit` throws.
FittedModel fit_parameters(const EstimatorEntry& entry, const FitRuns& runs,
                           const FitParameters& fit);

/// As the model's passport says, if it is the entry's own; the legs are those of the robot that is
/// listened to, where they are known.
template <typename Config>
Config configured(Config config, const EstimatorEntry& entry, const EstimatorSetup& setup) {
  const std::optional<ModelMetadata>& metadata = setup.model->metadata;
  if (metadata && metadata->estimator == entry.name) configure(config, metadata->configuration);
  if (setup.legs) config.geometry = *setup.legs;
  return config;
}

}  // namespace touchdown::experiments
