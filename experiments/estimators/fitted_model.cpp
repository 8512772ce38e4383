#include "experiments/estimators/fitted_model.hpp"

#include <algorithm>
#include <string_view>

#include "recordings/models/measurement_model.hpp"
#include "recordings/models/npz.hpp"

namespace touchdown::experiments {

ModelKind kind_of_model_file(const std::filesystem::path& path) {
  const std::vector<std::string> names = recordings::npz_names(path);
  const auto has = [&](std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  if (has(recordings::estimator_array)) return ModelKind::parameters;
  return has("transition") ? ModelKind::phase : ModelKind::measurement;
}

FittedModel read_fitted_model(ModelKind kind, const std::filesystem::path& path) {
  switch (kind) {
    case ModelKind::measurement:
      return {.measurement = recordings::read_measurement_model(path)};
    case ModelKind::phase:
      return {.phase = std::make_shared<const recordings::PhaseModelFile>(
                  recordings::read_phase_model(path))};
    case ModelKind::parameters:
      return {.parameters = std::make_shared<const recordings::ParameterModelFile>(
                  recordings::read_parameter_model(path))};
  }
  return {};
}

void write_fitted_model(const FittedModel& model, const std::filesystem::path& path) {
  if (model.measurement) recordings::write_measurement_model(*model.measurement, path);
  if (model.phase) recordings::write_phase_model(*model.phase, path);
  if (model.parameters) recordings::write_parameter_model(*model.parameters, path);
}

}  // namespace touchdown::experiments
