#pragma once

#include <functional>
#include <span>

#include "estimator/labelled_run.hpp"
#include "estimator/models/configuration.hpp"
#include "experiments/estimators/entry.hpp"

namespace touchdown::experiments {

/// Fits an estimator's named parameters to labelled runs.
using FitParameters = std::function<recordings::Parameters(std::span<const LabelledRun> runs)>;

/// Fits the model of an entry with parameters of its own, and records its provenance. It uses whole
/// runs, each without its beginning. Errors: `InputError` for runs of reserved seeds, and the
/// errors of `fit`.
FittedModel fit_parameters(const EstimatorEntry& entry, const FitRuns& runs,
                           const FitParameters& fit);

/// The configuration with the values of the model's metadata, if the model was fitted for this
/// entry. The legs are those of the evaluated robot, if they are known.
template <typename Config>
Config configured(Config config, const EstimatorEntry& entry, const EstimatorSetup& setup) {
  const std::optional<ModelMetadata>& metadata = setup.model->metadata;
  if (metadata && metadata->estimator == entry.name) configure(config, metadata->configuration);
  if (setup.legs) config.geometry = *setup.legs;
  return config;
}

}  // namespace touchdown::experiments
