#pragma once

#include <map>
#include <string>
#include <vector>

#include "estimator/models/model.hpp"
#include "experiments/estimators/fits.hpp"

namespace touchdown::experiments {

/// Values of an estimator's hyperparameters that replace its defaults, by name.
using HyperparameterValues = std::map<std::string, double>;

/// An estimator's model in an experiment. An estimator that is not fitted has hyperparameters only.
struct FittedModel : Model {
  /// The values for fitting and running the estimator; empty: its defaults. Model files do
  /// not contain them.
  HyperparameterValues hyperparameters = {};
};

/// Parses assignments of the form "name=number". Errors: `InputError` for anything else, and for a
/// name that comes twice.
HyperparameterValues hyperparameters_of(const std::vector<std::string>& assignments);

/// Copies those values into the configuration of the metadata that it has.
void put_into(ModelMetadata& metadata, const HyperparameterValues& hyperparameters);

/// Adds the metadata and the provenance of a new fit. Its configuration takes over those values as
/// `put_into` does.
void describe_fit(const std::string& estimator, const FittedTo& fitted_to,
                  const HyperparameterValues& hyperparameters, Model& model);

/// Models by the key of their fit (`model_key`), then by estimator. Estimators with the same fit
/// share a model.
using FittedModels = std::map<std::string, std::map<std::string, FittedModel>>;

}  // namespace touchdown::experiments
