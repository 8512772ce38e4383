#include "policies/tether.hpp"

#include <algorithm>
#include <vector>

namespace touchdown {

namespace {

void read_vector(YamlMap& map, std::string_view key, Eigen::Vector3d& value) {
  std::vector<double> numbers(value.begin(), value.end());
  map.read(key, numbers);
  if (numbers.size() != 3) map.fail(key, "expected three numbers: x, y, z");
  value = Eigen::Vector3d(numbers[0], numbers[1], numbers[2]);
}

YAML::Node to_node(const Eigen::Vector3d& value) {
  YAML::Node node;
  for (const double x : value) node.push_back(x);
  node.SetStyle(YAML::EmitterStyle::Flow);
  return node;
}

}  // namespace

Eigen::Vector3d tether_force(const Tether& tether, const GroundTruth& robot) {
  const Eigen::Vector3d lever = robot.base_orientation * tether.point_in_base;
  const Eigen::Vector3d rope = tether.anchor - (robot.base_position + lever);
  const double distance = rope.norm();
  if (distance <= tether.length) return Eigen::Vector3d::Zero();
  const Eigen::Vector3d direction = rope / distance;
  const double lengthening =
      -direction.dot(robot.base_linear_velocity + robot.base_angular_velocity.cross(lever));
  const double pull = tether.stiffness * (distance - tether.length) + tether.damping * lengthening;
  return std::max(0.0, pull) * direction;
}

Tether tether_from_yaml(YamlMap map) {
  Tether tether;
  read_vector(map, "anchor", tether.anchor);
  read_vector(map, "point_in_base", tether.point_in_base);
  map.read("length", tether.length, 0.0, 100.0);
  map.read("stiffness", tether.stiffness, 0.0, 1e6);
  map.read("damping", tether.damping, 0.0, 1e5);
  map.finish();
  return tether;
}

YAML::Node to_yaml(const Tether& tether) {
  YAML::Node node;
  node["anchor"] = to_node(tether.anchor);
  node["point_in_base"] = to_node(tether.point_in_base);
  node["length"] = tether.length;
  node["stiffness"] = tether.stiffness;
  node["damping"] = tether.damping;
  return node;
}

}  // namespace touchdown
