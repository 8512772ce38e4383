#include "experiments/estimators/fitted_model.hpp"

#include <algorithm>

#include "recordings/models/measurement_model.hpp"
#include "recordings/models/npz.hpp"

namespace touchdown::experiments {

ModelKind kind_of_model_file(const std::filesystem::path& path) {
  const std::vector<std::string> names = recordings::npz_names(path);
  return std::find(names.begin(), names.end(), "transition") != names.end()
             ? ModelKind::phase
             : ModelKind::measurement;
}

FittedModel read_fitted_model(ModelKind kind, const std::filesystem::path& path) {
  if (kind == ModelKind::measurement) return {recordings::read_measurement_model(path), nullptr};
  return {{},
          std::make_shared<const recordings::PhaseModelFile>(recordings::read_phase_model(path))};
}

void write_fitted_model(const FittedModel& model, const std::filesystem::path& path) {
  if (model.measurement) recordings::write_measurement_model(*model.measurement, path);
  if (model.phase) recordings::write_phase_model(*model.phase, path);
}

}  // namespace touchdown::experiments
