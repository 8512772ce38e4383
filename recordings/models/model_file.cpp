#include "recordings/models/model_file.hpp"

#include "estimator/models/model_for_robot.hpp"

namespace touchdown::recordings {

ModelMetadata copy_model(const std::filesystem::path& from, const std::filesystem::path& to,
                         const ModelUse& use) {
  const NpzArrays arrays =
      made_of_npz(from, any_array, [&](const NpzArrays& whole) { return model_for(whole, use); });
  write_npz(arrays, to);
  return *metadata_of(arrays);
}

void write_model(NpzArrays arrays, const std::filesystem::path& path,
                 const std::optional<ModelMetadata>& metadata) {
  if (metadata) add_metadata(arrays, *metadata);
  write_npz(arrays, path);
}

}  // namespace touchdown::recordings
