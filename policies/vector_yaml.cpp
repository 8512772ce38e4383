#include "policies/vector_yaml.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace touchdown {

void read_vector(YamlMap& map, std::string_view key, Eigen::Vector3d& value) {
  std::vector<double> numbers(value.begin(), value.end());
  map.read(key, numbers);
  if (numbers.size() != 3 ||
      !std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); })) {
    map.fail(key, "expected three numbers: x, y, z");
  }
  value = Eigen::Vector3d(numbers[0], numbers[1], numbers[2]);
}

YAML::Node to_node(const Eigen::Vector3d& value) {
  YAML::Node node;
  for (const double x : value) node.push_back(x);
  node.SetStyle(YAML::EmitterStyle::Flow);
  return node;
}

}  // namespace touchdown
