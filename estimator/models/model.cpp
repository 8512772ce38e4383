#include "estimator/models/model.hpp"

#include <algorithm>
#include <utility>

#include "core/error.hpp"
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

namespace {

std::string numbered(const char* what, std::size_t i) {
  return std::string(what) + "_" + std::to_string(i) + "_";
}

ModelArray ends(const Axis& axis) {
  return {{3}, {axis.lower, axis.upper, static_cast<double>(axis.count)}};
}

ModelArray table(const std::vector<float>& values, std::size_t columns) {
  return {{values.size() / columns, columns}, {values.begin(), values.end()}};
}

/// Reads arrays of a model. Errors: `InputError` that names a missing array or one of a wrong size.
class PhaseArrays {
 public:
  explicit PhaseArrays(const ModelArrays& arrays) : arrays_(arrays) {}

  bool has(const std::string& name) const { return arrays_.contains(name); }

  const std::vector<double>& take(const std::string& name) const {
    require_arrays(arrays_, "phase model", {name});
    return arrays_.at(name).data;
  }

  const std::vector<double>& take(const std::string& name, std::size_t size) const {
    const std::vector<double>& data = take(name);
    if (data.size() != size) {
      throw InputError(name + ": expected " + std::to_string(size) + " values, found " +
                       std::to_string(data.size()));
    }
    return data;
  }

  Axis axis(const std::string& name) const {
    const std::vector<double>& data = take(name, 3);
    constexpr double most = 1e8;
    if (!(data[2] >= 2.0 && data[2] <= most)) {
      throw InputError(name + ": expected 2 points or more");
    }
    return {data[0], data[1], static_cast<int>(data[2])};
  }

  std::vector<float> floats(const std::string& name) const {
    const std::vector<double>& data = take(name);
    return {data.begin(), data.end()};
  }

 private:
  const ModelArrays& arrays_;
};

}  // namespace

ModelArrays arrays_of(const PhaseModel& model) {
  ModelArrays arrays;
  arrays["sample_rate"] = {{1}, {model.sample_rate}};
  arrays["seconds"] = {{phase_count}, {model.seconds.begin(), model.seconds.end()}};
  ModelArray transition{{phase_count, phase_count}, {}};
  for (const auto& row : model.transition) {
    transition.data.insert(transition.data.end(), row.begin(), row.end());
  }
  arrays["transition"] = transition;
  for (std::size_t i = 0; i < model.torque.size(); ++i) {
    const PhaseTorqueDensity& density = model.torque[i];
    const std::string name = numbered("torque", i);
    arrays[name + "noise"] = {
        {4},
        {density.noise.knee, density.noise.wheel, density.bandwidth.knee, density.bandwidth.wheel}};
    arrays[name + "knee"] = ends(density.knee);
    arrays[name + "wheel"] = ends(density.wheel);
    arrays[name + "log_density"] = table(density.log_density, torque_density_count);
  }
  for (std::size_t i = 0; i < model.acceleration.size(); ++i) {
    const PhaseAccelerationDensity& density = model.acceleration[i];
    const std::string name = numbered("acceleration", i);
    arrays[name + "noise"] = {{2}, {density.noise, density.bandwidth}};
    arrays[name + "axis"] = ends(density.axis);
    arrays[name + "log_density"] = table(density.log_density, acceleration_density_count);
  }
  return arrays;
}

PhaseModel phase_model_of(const ModelArrays& arrays) {
  const PhaseArrays reader(arrays);
  PhaseModel model;
  model.sample_rate = reader.take("sample_rate", 1)[0];
  const std::vector<double>& seconds = reader.take("seconds", phase_count);
  std::copy(seconds.begin(), seconds.end(), model.seconds.begin());
  const std::vector<double>& transition = reader.take("transition", phase_count * phase_count);
  for (std::size_t i = 0; i < phase_count; ++i) {
    for (std::size_t j = 0; j < phase_count; ++j) {
      model.transition[i][j] = transition[i * phase_count + j];
    }
  }
  for (std::size_t i = 0; reader.has(numbered("torque", i) + "noise"); ++i) {
    const std::string name = numbered("torque", i);
    const std::vector<double>& noise = reader.take(name + "noise", 4);
    model.torque.push_back({{noise[0], noise[1]},
                            {noise[2], noise[3]},
                            reader.axis(name + "knee"),
                            reader.axis(name + "wheel"),
                            reader.floats(name + "log_density")});
  }
  for (std::size_t i = 0; reader.has(numbered("acceleration", i) + "noise"); ++i) {
    const std::string name = numbered("acceleration", i);
    const std::vector<double>& noise = reader.take(name + "noise", 2);
    model.acceleration.push_back(
        {noise[0], noise[1], reader.axis(name + "axis"), reader.floats(name + "log_density")});
  }
  check_phase_model(model);
  return model;
}

}  // namespace touchdown
