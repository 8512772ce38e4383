#include "recordings/models/measurement_model.hpp"

#include "recordings/models/model_file.hpp"

namespace touchdown::recordings {

namespace {

/// Size limits, far above what `touchdown fit` writes.
std::size_t needed(std::string_view name) {
  constexpr std::size_t most_points = 20'000;
  constexpr std::size_t most_cells = std::size_t{1} << 25U;
  if (name == metadata_array) return most_text;
  if (name == "wheel_torque" || name == "knee_torque") return most_points;
  return name == "contact_likelihood" || name == "no_contact_likelihood" ? most_cells : 0;
}

}  // namespace

MeasurementModel read_measurement_model(const std::filesystem::path& path,
                                        std::optional<ModelMetadata>* metadata) {
  return read_model(path, needed, metadata, measurement_model_of);
}

void write_measurement_model(const MeasurementModel& model, const std::filesystem::path& path,
                             const std::optional<ModelMetadata>& metadata) {
  write_model(arrays_of(model), path, metadata);
}

}  // namespace touchdown::recordings
