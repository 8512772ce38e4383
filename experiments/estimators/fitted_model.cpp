#include "experiments/estimators/fitted_model.hpp"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "estimator/models/make_estimator.hpp"
#include "estimator/numerics/number_text.hpp"
#include "recordings/models/measurement_model.hpp"
#include "recordings/models/npz.hpp"

namespace touchdown::experiments {

ModelMetadata new_metadata(const std::string& estimator, const FittedTo& fitted_to) {
  return {.estimator = estimator,
          .sample_rate = fitted_to.sample_rate,
          .robot = fmt::format("{}", fmt::join(fitted_to.robots, ", ")),
          .configuration = makes_estimator(estimator)
                               ? default_configuration(estimator, fitted_to.sample_rate,
                                                       fitted_to.legs, fitted_to.servo_load)
                               : ConfigurationText{},
          .fingerprint = {}};
}

HyperparameterValues hyperparameters_of(const std::vector<std::string>& assignments) {
  HyperparameterValues hyperparameters;
  for (const std::string& one : assignments) {
    const std::size_t equals = std::min(one.find('='), one.size());
    const std::optional<double> value =
        equals < one.size() ? number_of(one.substr(equals + 1)) : std::nullopt;
    if (equals == 0 || !value)
      throw InputError(fmt::format("{}: expected name=number, as in leave_below=0.25", one));
    hyperparameters[one.substr(0, equals)] = *value;
  }
  return hyperparameters;
}

void put_into(ModelMetadata& metadata, const HyperparameterValues& hyperparameters) {
  for (const auto& [name, value] : hyperparameters) {
    const bool is_known =
        metadata.configuration.contains(name) || !makes_estimator(metadata.estimator);
    if (is_known) metadata.configuration[name] = text_of(value);
  }
}

ModelKind kind_of_model_file(const std::filesystem::path& path) {
  const std::vector<std::string> names = recordings::npz_names(path);
  const auto has = [&](std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  if (has(estimator_array)) return ModelKind::parameters;
  return has("transition") ? ModelKind::phase : ModelKind::measurement;
}

FittedModel read_fitted_model(ModelKind kind, const std::filesystem::path& path) {
  FittedModel model;
  switch (kind) {
    case ModelKind::measurement:
      model.measurement = recordings::read_measurement_model(path, &model.metadata);
      break;
    case ModelKind::phase:
      model.phase = std::make_shared<const recordings::PhaseModelFile>(
          recordings::read_phase_model(path, &model.metadata));
      break;
    case ModelKind::parameters:
      model.parameters = std::make_shared<const recordings::ParameterModelFile>(
          recordings::read_parameter_model(path, &model.metadata));
      break;
  }
  return model;
}

void write_fitted_model(const FittedModel& model, const std::filesystem::path& path) {
  if (model.measurement) {
    recordings::write_measurement_model(*model.measurement, path, model.metadata);
  }
  if (model.phase) recordings::write_phase_model(*model.phase, path, model.metadata);
  if (model.parameters) recordings::write_parameter_model(*model.parameters, path, model.metadata);
}

}  // namespace touchdown::experiments
