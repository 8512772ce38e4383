#include "policies/guide.hpp"

#include "policies/vector_yaml.hpp"

namespace touchdown::policies {

Eigen::Vector3d guide_force(const Guide& guide, const models::GroundTruth& robot) {
  const Eigen::Vector3d lever = robot.base_orientation * guide.point_in_base;
  const Eigen::Vector3d place = robot.base_position + lever;
  const Eigen::Vector3d velocity =
      robot.base_linear_velocity + robot.base_angular_velocity.cross(lever);
  const Eigen::Vector3d force =
      guide.stiffness * (Eigen::Vector3d(guide.x, guide.y, 0.0) - place) - guide.damping * velocity;
  return {force.x(), force.y(), 0.0};
}

void describe(Fields& fields, Guide& guide) {
  fields("x", guide.x, -1e3, 1e3);
  fields("y", guide.y, -1e3, 1e3);
  describe_vector(fields, "point_in_base", guide.point_in_base);
  fields("stiffness", guide.stiffness, 0.0, 1e6);
  fields("damping", guide.damping, 0.0, 1e5);
}

}  // namespace touchdown::policies
