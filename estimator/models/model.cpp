#include "estimator/models/model.hpp"

#include <utility>

#include "core/error.hpp"

namespace touchdown {

namespace {

bool has(const ModelArrays& arrays, std::string_view name) {
  return arrays.contains(std::string(name));
}

/// Errors: `InputError` for the models of estimators that other versions have: those of named
/// arrays, and of densities of phases.
void check_estimator(const Model& model, const ModelArrays& arrays) {
  std::string name;
  if (has(arrays, "transition")) {
    name = model.metadata ? model.metadata->estimator : "phase";
  } else if (has(arrays, estimator_array)) {
    name = text_of_array(arrays.at(std::string(estimator_array)), std::string(estimator_array));
  }
  if (name.empty() || name == load_filter_name) return;
  throw InputError("was fitted for '" + name +
                   "', which this version does not have; 'load_filter' needs no model, only the "
                   "robot's file");
}

}  // namespace

bool has_numbers(const Model& model) { return model.grid || !model.arrays.empty(); }

Model model_of(ModelArrays arrays) {
  Model model;
  model.metadata = metadata_of(arrays);  // this checks the fingerprint of the arrays
  arrays.erase(std::string(metadata_array));
  check_estimator(model, arrays);
  if (has(arrays, "gru_input_weight")) {
    (void)neural_network_of(arrays);
  } else if (!has(arrays, estimator_array)) {
    model.grid = measurement_model_of(arrays);
  }
  model.arrays = std::move(arrays);
  return model;
}

ModelArrays arrays_of(const Model& model) {
  ModelArrays arrays = model.arrays;
  if (model.grid) arrays.merge(arrays_of(*model.grid));  // those of a file stay as they were
  if (model.metadata) add_metadata(arrays, *model.metadata);
  return arrays;
}

std::string estimator_of(const Model& model) {
  if (model.metadata) return model.metadata->estimator;
  const std::string name(estimator_array);
  if (model.arrays.contains(name)) return text_of_array(model.arrays.at(name), name);
  return model.grid ? "" : "nmn";
}

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
  return MeasurementModel(LikelihoodGrids{axis_from_points(arrays.at("knee_torque").data),
                                          axis_from_points(arrays.at("wheel_torque").data),
                                          grid(arrays, "contact_likelihood"),
                                          grid(arrays, "no_contact_likelihood")});
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

namespace {

/// Calls `visit(name, array)` for every array of the network.
template <typename Network, typename Visit>
void for_each_array(Network& network, const Visit& visit) {
  visit("input_mean", network.input_mean);
  visit("input_scale", network.input_scale);
  const auto layer = [&](const std::string& name, auto& dense) {
    visit(name + "_weight", dense.weight);
    visit(name + "_bias", dense.bias);
  };
  layer("gru_input", network.gru_input);
  layer("gru_hidden", network.gru_hidden);
  layer("first", network.first);
  layer("second", network.second);
  layer("heads", network.heads);
}

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

ModelArray to_array(const Eigen::MatrixXf& matrix, bool is_vector) {
  ModelArray array{{static_cast<std::size_t>(matrix.rows())}, {}};
  if (!is_vector) array.shape.push_back(static_cast<std::size_t>(matrix.cols()));
  const RowMajor rows = matrix.cast<double>();
  array.data.assign(rows.data(), rows.data() + rows.size());
  return array;
}

}  // namespace

NeuralNetwork neural_network_of(const ModelArrays& arrays) {
  NeuralNetwork network;
  std::vector<std::string> names = {"period"};
  for_each_array(network, [&](const std::string& name, const auto&) { names.push_back(name); });
  require_arrays(arrays, "neural measurement network", names);
  for_each_array(network, [&]<typename Matrix>(const std::string& name, Matrix& matrix) {
    const ModelArray& array = arrays.at(name);
    constexpr std::size_t axes = Matrix::ColsAtCompileTime == 1 ? 1 : 2;
    if (array.shape.size() != axes) {
      throw InputError(name + ": expected " + std::to_string(axes) + " axes, found " +
                       std::to_string(array.shape.size()));
    }
    matrix = Eigen::Map<const RowMajor>(array.data.data(), static_cast<Eigen::Index>(array.rows()),
                                        static_cast<Eigen::Index>(array.columns()))
                 .cast<float>();
  });
  const std::vector<double>& period = arrays.at("period").data;
  if (period.size() != 1) throw InputError("period: expected one number (s)");
  network.period = period[0];
  check(network);
  return network;
}

ModelArrays arrays_of(const NeuralNetwork& network) {
  ModelArrays arrays;
  arrays["period"] = {{1}, {network.period}};
  for_each_array(network, [&]<typename Matrix>(const std::string& name, const Matrix& matrix) {
    arrays[name] = to_array(matrix, Matrix::ColsAtCompileTime == 1);
  });
  return arrays;
}

}  // namespace touchdown
