#include "recordings/models/neural_network.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/resources.hpp"
#include "estimator/models/neural.hpp"
#include "recordings/models/npz.hpp"

namespace touchdown::recordings {

void write_neural_network(const NeuralNetwork& network, const std::filesystem::path& path) {
  write_npz(arrays_of(network), path);
}

NeuralNetwork read_neural_network(const std::filesystem::path& path) {
  const std::vector<std::string> names = neural_array_names();
  const auto needed = [&](std::string_view name) {
    constexpr std::size_t most_weights = std::size_t{1} << 24U;
    return std::find(names.begin(), names.end(), name) != names.end() ? most_weights : 0;
  };
  return made_of_npz(path, needed, neural_network_of);
}

NeuralNetwork shipped_neural_network(const std::string& name) {
  const std::string file = fmt::format("models/{}.npz", name);
  std::filesystem::path path;
  try {
    path = find_resource(file);
  } catch (const InputError&) {
    throw InputError(fmt::format(
        "{0}: {1} is missing; 'touchdown train experiments/{0}.yaml -o {1}' makes it in less than "
        "20 minutes (training needs the packages libtorch-dev and libopenblas0-openmp)",
        name, file));
  }
  return read_neural_network(path);
}

}  // namespace touchdown::recordings
