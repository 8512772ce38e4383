#include "policies/side_view.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace touchdown::policies {

namespace {

/// Rotates forward: a vector that points down moves to the front.
Eigen::Vector2d bent(double angle, const Eigen::Vector2d& v) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

Eigen::Vector2d seen(const Eigen::Vector3d& v) { return {v.x(), v.z()}; }

struct Part {
  double mass = 0.0;       ///< kg
  Eigen::Vector2d centre;  ///< of mass (m)
};

/// The body that moves another one: the base, or that of the nearest servo above it. Bodies that
/// are fixed or held move with it.
int moved_with(const models::RobotModel& robot, int body) {
  const mjModel& mj = *robot.mj;
  for (; body != robot.base_body && body > 0; body = mj.body_parentid[body]) {
    if (mj.body_jntnum[body] == 0) continue;
    const int joint = mj.body_jntadr[body];
    if (std::find(robot.joint.begin(), robot.joint.end(), joint) != robot.joint.end()) break;
  }
  return body;
}

/// A body and all that move with it, at zero.
Part part_of(const models::RobotModel& robot, const mjData& data, int body) {
  const mjModel& mj = *robot.mj;
  Part part{mj.body_mass[body], seen(models::vector_at(data.xipos, body))};
  for (int other = 1; other < mj.nbody; ++other) {
    if (other == body || mj.body_mass[other] == 0.0 || moved_with(robot, other) != body) continue;
    const double share = mj.body_mass[other] / (part.mass + mj.body_mass[other]);
    part.centre += share * (seen(models::vector_at(data.xipos, other)) - part.centre);
    part.mass += mj.body_mass[other];
  }
  return part;
}

}  // namespace

Eigen::Vector2d SideView::centre(double hip, double knee, double pitch) const {
  const Eigen::Vector2d to_knee = bent(hip, {0.0, -upper_length});
  const Eigen::Vector2d to_axle = to_knee + bent(hip + knee, {0.0, -lower_length});
  const Eigen::Vector2d moments = torso_mass * torso_centre + upper_mass * bent(hip, upper_centre) +
                                  lower_mass * (to_knee + bent(hip + knee, lower_centre));
  return bent(-pitch, moments / (torso_mass + upper_mass + lower_mass) - to_axle);
}

SideView side_view(const models::RobotModel& robot) {
  const mjModel& mj = *robot.mj;
  if (!robot.has(models::index(models::Servo::left_hip))) {
    throw InputError(robot.name + ": soft_landing: expected legs with hips");
  }
  const models::MjDataPtr data = models::at_zero(robot);
  const auto joint = [&](models::Servo servo) { return robot.joint[models::index(servo)]; };
  const auto anchor = [&](models::Servo servo) {
    return seen(models::vector_at(data->xanchor, joint(servo)));
  };
  const Part torso = part_of(robot, *data, robot.base_body);
  SideView view;
  view.torso_mass = torso.mass;
  view.mass = mj.body_subtreemass[robot.base_body];
  view.upper_centre = view.lower_centre = view.torso_centre = Eigen::Vector2d::Zero();
  for (std::size_t side = 0; side < models::wheel_count; ++side) {
    const auto hip = static_cast<models::Servo>(3 * side);
    const auto knee = static_cast<models::Servo>(3 * side + 1);
    const Part upper = part_of(robot, *data, mj.jnt_bodyid[joint(hip)]);
    const Part lower = part_of(robot, *data, mj.jnt_bodyid[joint(knee)]);
    const Eigen::Vector2d axle = seen(models::vector_at(data->geom_xpos, robot.tyre_geom[side]));
    view.upper_mass += upper.mass;
    view.lower_mass += lower.mass;
    view.torso_centre += 0.5 * (torso.centre - anchor(hip));
    view.upper_centre += 0.5 * (upper.centre - anchor(hip));
    view.lower_centre += 0.5 * (lower.centre - anchor(knee));
    view.upper_length += 0.5 * (anchor(knee) - anchor(hip)).norm();
    view.lower_length += 0.5 * (axle - anchor(knee)).norm();
    view.forward[side] = models::vector_at(data->xaxis, joint(hip)).y() < 0.0 ? 1.0 : -1.0;
  }
  return view;
}

}  // namespace touchdown::policies
