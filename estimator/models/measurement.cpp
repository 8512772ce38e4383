#include "core/error.hpp"
#include "estimator/models/metadata.hpp"
#include "estimator/models/model.hpp"

namespace touchdown {

namespace {

std::string shape_text(const std::vector<std::size_t>& shape) {
  std::string text;
  for (const std::size_t axis : shape) text += (text.empty() ? "" : ", ") + std::to_string(axis);
  return "(" + text + ")";
}

/// One row per wheel torque, one column per knee torque.
const std::vector<double>& grid(const ModelArrays& arrays, const char* name) {
  const ModelArray& grid = arrays.at(name);
  const std::vector<std::size_t> expected = {arrays.at("wheel_torque").data.size(),
                                             arrays.at("knee_torque").data.size()};
  if (grid.shape == expected) return grid.data;
  throw InputError(std::string(name) + ": expected shape " + shape_text(expected) +
                   " from the axes, found " + shape_text(grid.shape));
}

ModelArray points(const Axis& axis) {
  ModelArray array{{static_cast<std::size_t>(axis.count)}, {}};
  for (int i = 0; i < axis.count; ++i) array.data.push_back(axis[i]);
  return array;
}

}  // namespace

MeasurementModel measurement_model_of(const ModelArrays& arrays) {
  require_arrays(arrays, "measurement model",
                 {"wheel_torque", "knee_torque", "contact_likelihood", "no_contact_likelihood"});
  const std::vector<double>& contact = grid(arrays, "contact_likelihood");
  const std::vector<double>& no_contact = grid(arrays, "no_contact_likelihood");
  return MeasurementModel(likelihood_grids(arrays.at("knee_torque").data,
                                           arrays.at("wheel_torque").data, contact, no_contact));
}

ModelArrays arrays_of(const MeasurementModel& model) {
  const LikelihoodGrids grids = model.grids();
  const std::vector<std::size_t> shape = {static_cast<std::size_t>(grids.wheel.count),
                                          static_cast<std::size_t>(grids.knee.count)};
  ModelArrays arrays;
  arrays["wheel_torque"] = points(grids.wheel);
  arrays["knee_torque"] = points(grids.knee);
  arrays[std::string(derived_array)] = {shape, contact_probability(grids)};
  arrays["contact_likelihood"] = {shape, grids.contact};
  arrays["no_contact_likelihood"] = {shape, grids.no_contact};
  return arrays;
}

}  // namespace touchdown
