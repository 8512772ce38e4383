#include "estimator/npz/load_estimator.hpp"

#include <algorithm>

#include "estimator/npz/npz.hpp"

namespace touchdown {

namespace {

bool is_of_grid(std::string_view name) {
  return name == "wheel_torque" || name == "knee_torque" || name == "contact_likelihood" ||
         name == "no_contact_likelihood" || name == metadata_array || name == provenance_array;
}

/// Which arrays of a file belong to the model: of a grid only its own, because the file may hold
/// others; all arrays of other models.
NpzNeeds model_needs(const std::filesystem::path& path) {
  const std::vector<std::string> names = npz_names(path);
  const auto has = [&](std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  if (has("contact_likelihood")) return is_of_grid;
  return {};
}

/// What `make` makes of a file's model. The errors of `make` get the file's name in front.
template <typename Make>
auto made_of_file(const std::filesystem::path& path, const Make& make) {
  ModelArrays arrays = read_npz(path, model_needs(path));
  try {
    return make(model_of(std::move(arrays)));
  } catch (const InputError& error) {
    throw InputError(path.string() + ": " + error.what());
  }
}

}  // namespace

Model load_model(const std::filesystem::path& path) {
  return made_of_file(path, [](Model model) { return model; });
}

std::unique_ptr<ContactEstimator> load_estimator(const std::filesystem::path& path,
                                                 const ModelUse& use) {
  return made_of_file(path, [&](const Model& model) { return make_estimator(model, use); });
}

ClosedLegs load_closed_legs(const std::filesystem::path& path) {
  const ModelArrays arrays = read_npz(path);
  try {
    return closed_legs_of(arrays);
  } catch (const InputError& error) {
    throw InputError(path.string() + ": " + error.what());
  }
}

ModelMetadata load_metadata(const std::filesystem::path& path, const ModelUse& use) {
  return made_of_file(path, [&](const Model& model) { return metadata_for(model, use); });
}

}  // namespace touchdown
