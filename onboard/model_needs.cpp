#include "onboard/model_needs.hpp"

#include <algorithm>

#include "estimator/models/metadata.hpp"
#include "estimator/models/parameters.hpp"

namespace touchdown {

namespace {

bool is_of_grid(std::string_view name) {
  return name == "wheel_torque" || name == "knee_torque" || name == "contact_likelihood" ||
         name == "no_contact_likelihood";
}

bool is_of_phase_model(std::string_view name) {
  return name == "sample_rate" || name == "seconds" || name == "transition" ||
         name == provenance_array || name.starts_with("torque_") ||
         name.starts_with("acceleration_");
}

}  // namespace

NpzNeeds model_needs(const std::filesystem::path& path) {
  const std::vector<std::string> names = npz_names(path);
  const auto has = [&](std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  bool (*belongs)(std::string_view) = is_of_grid;
  if (has("transition")) belongs = is_of_phase_model;
  if (has(estimator_array) || has("gru_input_weight")) {
    belongs = [](std::string_view /*name*/) { return true; };
  }
  return [belongs](std::string_view name) {
    return name == metadata_array || belongs(name) ? any_array(name) : 0;
  };
}

}  // namespace touchdown
