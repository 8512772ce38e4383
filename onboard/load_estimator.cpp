#include "onboard/load_estimator.hpp"

#include "onboard/model_needs.hpp"

namespace touchdown {

std::unique_ptr<ContactEstimator> load_estimator(const std::filesystem::path& path,
                                                 const ModelUse& use) {
  return made_of_npz(path, model_needs(path),
                     [&](const ModelArrays& arrays) { return make_estimator(arrays, use); });
}

ModelMetadata load_metadata(const std::filesystem::path& path, const ModelUse& use) {
  return made_of_npz(path, model_needs(path),
                     [&](const ModelArrays& arrays) { return metadata_for(arrays, use); });
}

}  // namespace touchdown
