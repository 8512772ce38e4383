#include "recordings/models/model_file.hpp"

#include <utility>

#include "estimator/models/model_for_robot.hpp"

namespace touchdown::recordings {

ModelMetadata copy_model(const std::filesystem::path& from, const std::filesystem::path& to,
                         const ModelUse& use) {
  NpzArrays arrays =
      made_of_npz(from, any_array, [&](const NpzArrays& whole) { return model_for(whole, use); });
  ModelMetadata metadata = *metadata_of(arrays);
  write_npz(std::move(arrays), to);
  return metadata;
}

void write_model(NpzArrays arrays, const std::filesystem::path& path,
                 const std::optional<ModelMetadata>& metadata) {
  if (metadata) add_metadata(arrays, *metadata);
  write_npz(std::move(arrays), path);
}

}  // namespace touchdown::recordings
