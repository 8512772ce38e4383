#include "policies/side_view.hpp"

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
  const auto centre = [&](int body) { return seen(models::vector_at(data->xipos, body)); };
  SideView view;
  view.torso_mass = mj.body_mass[robot.base_body];
  view.mass = mj.body_subtreemass[robot.base_body];
  view.upper_centre = view.lower_centre = view.torso_centre = Eigen::Vector2d::Zero();
  for (std::size_t side = 0; side < models::wheel_count; ++side) {
    const auto hip = static_cast<models::Servo>(3 * side);
    const auto knee = static_cast<models::Servo>(3 * side + 1);
    const int upper = mj.jnt_bodyid[joint(hip)];
    const int lower = mj.jnt_bodyid[joint(knee)];
    const Eigen::Vector2d axle = seen(models::vector_at(data->geom_xpos, robot.tyre_geom[side]));
    view.upper_mass += mj.body_mass[upper];
    view.lower_mass += mj.body_mass[lower];
    view.torso_centre += 0.5 * (centre(robot.base_body) - anchor(hip));
    view.upper_centre += 0.5 * (centre(upper) - anchor(hip));
    view.lower_centre += 0.5 * (centre(lower) - anchor(knee));
    view.upper_length += 0.5 * (anchor(knee) - anchor(hip)).norm();
    view.lower_length += 0.5 * (axle - anchor(knee)).norm();
    view.forward[side] = models::vector_at(data->xaxis, joint(hip)).y() < 0.0 ? 1.0 : -1.0;
  }
  return view;
}

}  // namespace touchdown::policies
