#include "policies/guide.hpp"

#include "policies/vector_yaml.hpp"

namespace touchdown {

Eigen::Vector3d guide_force(const Guide& guide, const GroundTruth& robot) {
  const Eigen::Vector3d lever = robot.base_orientation * guide.point_in_base;
  const Eigen::Vector3d place = robot.base_position + lever;
  const Eigen::Vector3d velocity =
      robot.base_linear_velocity + robot.base_angular_velocity.cross(lever);
  const Eigen::Vector3d force =
      guide.stiffness * (Eigen::Vector3d(guide.x, guide.y, 0.0) - place) - guide.damping * velocity;
  return {force.x(), force.y(), 0.0};
}

Guide guide_from_yaml(YamlMap map) {
  Guide guide;
  map.read("x", guide.x, -1e3, 1e3);
  map.read("y", guide.y, -1e3, 1e3);
  read_vector(map, "point_in_base", guide.point_in_base);
  map.read("stiffness", guide.stiffness, 0.0, 1e6);
  map.read("damping", guide.damping, 0.0, 1e5);
  map.finish();
  return guide;
}

YAML::Node to_yaml(const Guide& guide) {
  YAML::Node node;
  node["x"] = guide.x;
  node["y"] = guide.y;
  node["point_in_base"] = to_node(guide.point_in_base);
  node["stiffness"] = guide.stiffness;
  node["damping"] = guide.damping;
  return node;
}

}  // namespace touchdown
