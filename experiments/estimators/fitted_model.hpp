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

/// Values of an estimator's hyperparameters that replace its defaults, by name.
using HyperparameterValues = std::map<std::string, double>;

/// A fitted model: one of the three kinds, and its metadata. Older model files, and files from
/// elsewhere, have no metadata.
struct FittedModel {
  std::optional<MeasurementModel> measurement = {};
  std::shared_ptr<const recordings::PhaseModelFile> phase = {};
  std::shared_ptr<const recordings::ParameterModelFile> parameters = {};
  std::optional<ModelMetadata> metadata = {};
  /// The values for fitting and running the estimator; empty: its defaults. An estimator that is
  /// tuned but not fitted has only these. Model files do not contain them.
  HyperparameterValues hyperparameters = {};
};

/// The metadata of a new fit.
ModelMetadata new_metadata(const std::string& estimator, const FittedTo& fitted_to);

/// Parses assignments of the form "name=number". Errors: `InputError` for anything else.
HyperparameterValues hyperparameters_of(const std::vector<std::string>& assignments);

/// Copies values into the configuration of the metadata. For an estimator that the library makes,
/// it copies only those that the configuration has.
void put_into(ModelMetadata& metadata, const HyperparameterValues& hyperparameters);

/// Models by the key of their fit (`model_key`), then by estimator. Estimators with the same fit
/// share a model.
using FittedModels = std::map<std::string, std::map<std::string, FittedModel>>;

enum class ModelKind : int {
  measurement,  ///< densities of torques
  phase,
  parameters,  ///< named arrays of one estimator
};

/// The kind of a model file. A file that is neither of the latter two counts as the first.
/// Errors: `InputError` for an unreadable file.
ModelKind kind_of_model_file(const std::filesystem::path& path);

/// Errors: `InputError` for an unreadable file or one of another kind.
FittedModel read_fitted_model(ModelKind kind, const std::filesystem::path& path);
void write_fitted_model(const FittedModel& model, const std::filesystem::path& path);

}  // namespace touchdown::experiments
