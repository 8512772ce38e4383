#include "policies/forces.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "core/fields.hpp"

namespace touchdown::policies {

Eigen::Vector3d force_in_world(const TimedForce& force, double yaw) {
  if (!force.along_heading) return force.force;
  return Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) * force.force;
}

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

Eigen::Vector3d guide_force(const Guide& guide, const models::GroundTruth& robot) {
  const Eigen::Vector3d lever = robot.base_orientation * guide.point_in_base;
  const Eigen::Vector3d place = robot.base_position + lever;
  const Eigen::Vector3d velocity =
      robot.base_linear_velocity + robot.base_angular_velocity.cross(lever);
  const Eigen::Vector3d force =
      guide.stiffness * (Eigen::Vector3d(guide.x, guide.y, 0.0) - place) - guide.damping * velocity;
  return {force.x(), force.y(), 0.0};
}

void describe_vector(Fields& fields, std::string_view key, Eigen::Vector3d& value) {
  std::vector<double> numbers(value.begin(), value.end());
  fields.in_line(key, numbers);
  fields.check(numbers.size() == 3 && std::all_of(numbers.begin(), numbers.end(),
                                                  [](double x) { return std::isfinite(x); }),
               key, "expected three numbers: x, y, z");
  value = Eigen::Vector3d(numbers[0], numbers[1], numbers[2]);
}

void describe(Fields& fields, TimedForce& force) {
  fields("time", force.time, 0.0, 1e6);
  fields("duration", force.duration, 0.0, 1e6);
  describe_vector(fields, "force", force.force);
  describe_vector(fields, "point_in_base", force.point_in_base);
  fields("along_heading", force.along_heading);
}

void describe(Fields& fields, Tether& tether) {
  describe_vector(fields, "anchor", tether.anchor);
  describe_vector(fields, "point_in_base", tether.point_in_base);
  fields("length", tether.length, 0.0, 100.0);
  fields("stiffness", tether.stiffness, 0.0, 1e6);
  fields("damping", tether.damping, 0.0, 1e5);
}

void describe(Fields& fields, Guide& guide) {
  fields("x", guide.x, -1e3, 1e3);
  fields("y", guide.y, -1e3, 1e3);
  describe_vector(fields, "point_in_base", guide.point_in_base);
  fields("stiffness", guide.stiffness, 0.0, 1e6);
  fields("damping", guide.damping, 0.0, 1e5);
}

}  // namespace touchdown::policies
