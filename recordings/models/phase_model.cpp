#include "recordings/models/phase_model.hpp"

#include "estimator/models/phase.hpp"
#include "recordings/models/model_file.hpp"

namespace touchdown::recordings {

namespace {

std::size_t most_values(std::string_view name) {
  constexpr std::size_t most_cells = std::size_t{1} << 25U;
  constexpr std::size_t most_else = 1000;
  if (name == provenance_array || name == metadata_array) return most_text;
  if (name == "sample_rate" || name == "seconds" || name == "transition") return most_else;
  if (!name.starts_with("torque_") && !name.starts_with("acceleration_")) return 0;
  return name.ends_with("_log_density") ? most_cells : most_else;
}

}  // namespace

void write_phase_model(const PhaseModelFile& file, const std::filesystem::path& path,
                       const std::optional<ModelMetadata>& metadata) {
  NpzArrays arrays = arrays_of(file.model);
  arrays[std::string(provenance_array)] = array_of(file.provenance);
  write_model(std::move(arrays), path, metadata);
}

PhaseModelFile read_phase_model(const std::filesystem::path& path,
                                std::optional<ModelMetadata>* metadata) {
  return read_model(path, most_values, metadata, [](const NpzArrays& arrays) {
    PhaseModelFile file{phase_model_of(arrays), {}};
    const auto found = arrays.find(std::string(provenance_array));
    if (found != arrays.end()) file.provenance = provenance_from(found->second);
    return file;
  });
}

}  // namespace touchdown::recordings
