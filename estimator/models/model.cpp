#include "estimator/models/model.hpp"

#include <utility>

#include "estimator/models/parameters.hpp"

namespace touchdown {

namespace {

bool has(const ModelArrays& arrays, std::string_view name) {
  return arrays.contains(std::string(name));
}

/// Errors: `InputError` for texts and numbers that are none.
void check_parameters(const ModelArrays& arrays) {
  for (const auto& [name, array] : arrays) {
    if (is_text_array(name)) (void)text_of_array(array, name);
  }
  (void)parameters_of(arrays);
}

}  // namespace

bool has_numbers(const Model& model) { return model.grid || model.phase || !model.arrays.empty(); }

Model model_of(ModelArrays arrays) {
  Model model;
  model.metadata = metadata_of(arrays);  // this checks the fingerprint of the arrays
  arrays.erase(std::string(metadata_array));
  if (has(arrays, estimator_array)) {
    check_parameters(arrays);
  } else if (has(arrays, "transition")) {
    model.phase = std::make_shared<const PhaseModel>(phase_model_of(arrays));
    std::erase_if(arrays, [](const auto& each) { return each.first != provenance_array; });
  } else if (has(arrays, "gru_input_weight")) {
    (void)neural_network_of(arrays);
  } else {
    model.grid = measurement_model_of(arrays);
  }
  model.arrays = std::move(arrays);
  return model;
}

ModelArrays arrays_of(const Model& model) {
  ModelArrays arrays = model.arrays;
  if (model.grid) arrays.merge(arrays_of(*model.grid));  // those of a file stay as they were
  if (model.phase) arrays.merge(arrays_of(*model.phase));
  if (model.metadata) add_metadata(arrays, *model.metadata);
  return arrays;
}

std::string estimator_of(const Model& model) {
  if (model.metadata) return model.metadata->estimator;
  const std::string name(estimator_array);
  if (model.arrays.contains(name)) return text_of_array(model.arrays.at(name), name);
  if (model.phase) return "phase";
  return model.grid ? "" : "nmn";
}

}  // namespace touchdown
