#include "policies/tether.hpp"

#include <algorithm>

#include "policies/vector_yaml.hpp"

namespace touchdown::policies {

Eigen::Vector3d tether_force(const Tether& tether, const models::GroundTruth& robot) {
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

void describe(Fields& fields, Tether& tether) {
  describe_vector(fields, "anchor", tether.anchor);
  describe_vector(fields, "point_in_base", tether.point_in_base);
  fields("length", tether.length, 0.0, 100.0);
  fields("stiffness", tether.stiffness, 0.0, 1e6);
  fields("damping", tether.damping, 0.0, 1e5);
}

}  // namespace touchdown::policies
