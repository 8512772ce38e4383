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

KeyNotes describe_vector(Fields& fields, std::string_view key, Eigen::Vector3d& value) {
  std::vector<double> numbers(value.begin(), value.end());
  const KeyNotes notes = fields.in_line(key, numbers);
  fields.check(numbers.size() == 3 && std::all_of(numbers.begin(), numbers.end(),
                                                  [](double x) { return std::isfinite(x); }),
               key, "expected three numbers: x, y, z");
  value = Eigen::Vector3d(numbers[0], numbers[1], numbers[2]);
  return notes.type("list of x, y, z");
}

void describe(Fields& fields, TimedForce& force) {
  fields("time", force.time, 0.0, 1e6).doc("s", "Start of the force.");
  fields("duration", force.duration, 0.0, 1e6).doc("s", "How long it acts.");
  describe_vector(fields, "force", force.force).doc("N", "Force in the world frame.");
  describe_vector(fields, "point_in_base", force.point_in_base)
      .doc("m", "Point of action in the base frame.");
  fields("along_heading", force.along_heading)
      .doc("Whether the force turns with the robot's heading.");
}

void describe(Fields& fields, Tether& tether) {
  describe_vector(fields, "anchor", tether.anchor).doc("m", "Fixed end of the rope in the world.");
  describe_vector(fields, "point_in_base", tether.point_in_base)
      .doc("m", "Attachment point in the base frame.");
  fields("length", tether.length, 0.0, 100.0).doc("m", "The rope is slack below this length.");
  fields("stiffness", tether.stiffness, 0.0, 1e6).doc("N/m", "Stiffness of the rope.");
  fields("damping", tether.damping, 0.0, 1e5).doc("N·s/m", "Damping of the rope.");
}

void describe(Fields& fields, Guide& guide) {
  fields("x", guide.x, -1e3, 1e3).doc("m", "Place in the world, along the course.");
  fields("y", guide.y, -1e3, 1e3).doc("m", "Place in the world, across the course.");
  describe_vector(fields, "point_in_base", guide.point_in_base)
      .doc("m", "Attachment point in the base frame.");
  fields("stiffness", guide.stiffness, 0.0, 1e6).doc("N/m", "Horizontal stiffness.");
  fields("damping", guide.damping, 0.0, 1e5).doc("N·s/m", "Horizontal damping.");
}

}  // namespace touchdown::policies
