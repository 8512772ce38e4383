#include "policies/tether.hpp"

#include <algorithm>

#include "policies/vector_yaml.hpp"

namespace touchdown {

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
