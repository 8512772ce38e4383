#include "recordings/models/neural_network.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "core/resources.hpp"
#include "recordings/models/npz.hpp"

namespace touchdown::recordings {

namespace {

/// Calls `visit(name, array)` for every array of the file.
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

std::vector<std::string> array_names() {
  std::vector<std::string> names;
  names.emplace_back("period");
  NeuralNetwork network;
  for_each_array(network,
                 [&](const std::string& name, const auto& /*matrix*/) { names.push_back(name); });
  return names;
}

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

NpyArray to_array(const Eigen::MatrixXf& matrix, bool is_vector) {
  NpyArray array{{static_cast<std::size_t>(matrix.rows())}, {}};
  if (!is_vector) array.shape.push_back(static_cast<std::size_t>(matrix.cols()));
  const RowMajor rows = matrix.cast<double>();
  array.data.assign(rows.data(), rows.data() + rows.size());
  return array;
}

}  // namespace

void write_neural_network(const NeuralNetwork& network, const std::filesystem::path& path) {
  NpzArrays arrays;
  arrays["period"] = {{1}, {network.period}};
  for_each_array(network, [&]<typename Matrix>(const std::string& name, const Matrix& matrix) {
    arrays[name] = to_array(matrix, Matrix::ColsAtCompileTime == 1);
  });
  write_npz(arrays, path);
}

NeuralNetwork read_neural_network(const std::filesystem::path& path) {
  const std::vector<std::string> names = array_names();
  const auto needed = [&](std::string_view name) {
    constexpr std::size_t most_weights = std::size_t{1} << 24U;
    return std::find(names.begin(), names.end(), name) != names.end() ? most_weights : 0;
  };
  return made_of_npz(path, needed, [&](const NpzArrays& arrays) {
    NeuralNetwork network;
    require_arrays(arrays, "neural measurement network", names);
    for_each_array(network, [&]<typename Matrix>(const std::string& name, Matrix& matrix) {
      const NpyArray& array = arrays.at(name);
      constexpr std::size_t axes = Matrix::ColsAtCompileTime == 1 ? 1 : 2;
      if (array.shape.size() != axes) {
        throw InputError(
            fmt::format("{}: expected {} axes, found {}", name, axes, array.shape.size()));
      }
      matrix =
          Eigen::Map<const RowMajor>(array.data.data(), static_cast<Eigen::Index>(array.rows()),
                                     static_cast<Eigen::Index>(array.columns()))
              .cast<float>();
    });
    const std::vector<double>& period = arrays.at("period").data;
    if (period.size() != 1) throw InputError("period: expected one number (s)");
    network.period = period[0];
    check(network);
    return network;
  });
}

NeuralNetwork shipped_neural_network() {
  constexpr const char* file = "models/nmn.npz";
  std::filesystem::path path;
  try {
    path = find_resource(file);
  } catch (const InputError&) {
    throw InputError(fmt::format(
        "nmn: {} is missing; 'touchdown train experiments/nmn.yaml -o {}' makes it in less than "
        "20 minutes (training needs the packages libtorch-dev and libopenblas0-openmp)",
        file, file));
  }
  return read_neural_network(path);
}

}  // namespace touchdown::recordings
