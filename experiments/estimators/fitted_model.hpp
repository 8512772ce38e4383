#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "estimator/bayes/measurement_model.hpp"
#include "estimator/models/metadata.hpp"
#include "experiments/estimators/fit_runs.hpp"
#include "recordings/models/parameter_model.hpp"
#include "recordings/models/phase_model.hpp"

namespace touchdown::experiments {

/// HyperparameterValues of an estimator that are not its defaults, by name.
using HyperparameterValues = std::map<std::string, double>;

/// What an estimator was fitted with: one of the three, and what it says about itself; files that
/// are older than passports, or come from elsewhere, say nothing.
struct FittedModel {
  std::optional<MeasurementModel> measurement = {};
  std::shared_ptr<const recordings::PhaseModelFile> phase = {};
  std::shared_ptr<const recordings::ParameterModelFile> parameters = {};
  std::optional<ModelMetadata> metadata = {};
  /// That the estimator was fitted, and is run, with; empty: its defaults. All that there is for
  /// one that is tuned and not fitted. No part of a file.
  HyperparameterValues hyperparameters = {};
};

/// The passport of a model that is fitted now.
ModelMetadata new_metadata(const std::string& estimator, const FittedTo& fitted_to);

/// Of "name=number" each. Errors: `InputError` for anything else.
HyperparameterValues hyperparameters_of(const std::vector<std::string>& assignments);

/// Puts constants where the passport's configuration has them; of an estimator that the library
/// does not make, all of them.
void put_into(ModelMetadata& metadata, const HyperparameterValues& hyperparameters);

/// Models by engine that was fitted on, then by estimator. Estimators that need the same model
/// share it.
using FittedModels = std::map<std::string, std::map<std::string, FittedModel>>;

enum class ModelKind : int {
  measurement,  ///< densities of torques
  phase,
  parameters,  ///< named numbers that only one estimator knows the meaning of
};

/// Which of them a model file holds; one that is neither of the latter counts as the first.
/// Errors: `InputError` for an unreadable one.
ModelKind kind_of_model_file(const std::filesystem::path& path);

/// Errors: `InputError` for an unreadable file or one of the other kind.
FittedModel read_fitted_model(ModelKind kind, const std::filesystem::path& path);
void write_fitted_model(const FittedModel& model, const std::filesystem::path& path);

}  // namespace touchdown::experiments
