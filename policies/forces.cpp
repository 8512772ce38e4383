#include "policies/forces.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "core/fields.hpp"

namespace touchdown::policies {

double TimedForce::share_at(double t) const {
  if (!acts_at(t)) return 0.0;
  const double grown = rise > 0.0 ? (t - time) / rise : 1.0;
  const double left = fall > 0.0 ? (time + duration - t) / fall : 1.0;
  return std::min({1.0, grown, left});
}

Eigen::Vector3d force_in_world(const TimedForce& force, double t, double yaw) {
  Eigen::Vector3d now = force.share_at(t) * force.force;
  if (!force.along_heading) return now;
  return Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) * now;
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
  const auto ramp = [&](std::string_view key, double& seconds, std::string_view text) {
    // Written only if it is not zero: most forces are constant.
    if (!fields.reading() && !fields.documenting() && seconds == 0.0) return;
    fields(key, seconds, 0.0, 1e6).doc("s", text);
    fields.check(force.rise + force.fall <= force.duration, key,
                 "expected rise and fall to be at most as long as the duration");
  };
  ramp("rise", force.rise, "Time at its beginning in which it grows from zero.");
  ramp("fall", force.fall, "Time at its end in which it fades to zero.");
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
