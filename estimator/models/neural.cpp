#include "core/error.hpp"
#include "estimator/models/model.hpp"

namespace touchdown {

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

std::vector<std::string> neural_array_names() {
  std::vector<std::string> names;
  names.emplace_back("period");
  NeuralNetwork network;
  for_each_array(network,
                 [&](const std::string& name, const auto& /*matrix*/) { names.push_back(name); });
  return names;
}

NeuralNetwork neural_network_of(const ModelArrays& arrays) {
  NeuralNetwork network;
  require_arrays(arrays, "neural measurement network", neural_array_names());
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
