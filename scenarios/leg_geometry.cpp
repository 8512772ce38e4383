#include "scenarios/leg_geometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace touchdown::scenarios {

namespace {

using models::Servo;

constexpr std::array<Servo, 3> leg_servos = {Servo::left_hip, Servo::left_knee, Servo::left_wheel};

/// The bodies that one of the leg's joints moves and the next joint does not.
struct Link {
  double mass = 0.0;                                          ///< kg
  Eigen::Vector3d weighted_centre = Eigen::Vector3d::Zero();  ///< kg·m
};

int joint_of(const models::RobotModel& robot, Servo servo) {
  return robot.joint[models::index(servo)];
}

std::array<Link, leg_servos.size()> links_of(const models::RobotModel& robot, const mjData& data) {
  const mjModel& mj = *robot.mj;
  std::array<Link, leg_servos.size()> links;
  for (int body = 1; body < mj.nbody; ++body) {
    for (int above = body; above > 0; above = mj.body_parentid[above]) {
      const int joint = mj.body_jntnum[above] > 0 ? mj.body_jntadr[above] : -1;
      const auto mover = std::find_if(leg_servos.begin(), leg_servos.end(),
                                      [&](Servo servo) { return joint_of(robot, servo) == joint; });
      if (joint < 0) continue;  // fixed to the body above
      if (mover != leg_servos.end()) {
        Link& link = links[static_cast<std::size_t>(mover - leg_servos.begin())];
        link.mass += mj.body_mass[body];
        link.weighted_centre += mj.body_mass[body] * models::vector_at(data.xipos, body);
      }
      break;
    }
  }
  return links;
}

/// Inertia that the wheel's servo accelerates (kg·m²): wheel and rotor, about the axle.
double inertia_about_axle(const models::RobotModel& robot, const mjData& data) {
  const mjModel& mj = *robot.mj;
  return data.qM[mj.dof_Madr[robot.dof_address[models::index(Servo::left_wheel)]]];
}

/// Rounds to multiples of 1/`parts`: finer digits come from the arithmetic.
double rounded(double value, double parts) { return std::round(value * parts) / parts; }

/// A leg without a hip is like one with an infinitely long upper link and no torque at its hip:
/// with Fx = 0, `vertical_force` is then the knee's load over its lever. The factor on the lower
/// link's length leaves an error of a hundredth.
constexpr double without_hip = 100.0;

}  // namespace

LegGeometry leg_geometry(const models::RobotModel& robot) {
  const models::MjDataPtr data = models::at_zero(robot);
  const bool has_hip = robot.has(models::index(Servo::left_hip));
  const Eigen::Vector3d axis =
      models::vector_at(data->xaxis, joint_of(robot, leg_servos[has_hip ? 0 : 1]));
  const auto in_plane = [&](const Eigen::Vector3d& vector) -> Eigen::Vector3d {
    return vector - axis * axis.dot(vector);
  };
  std::array<Eigen::Vector3d, leg_servos.size()> anchor;
  for (std::size_t i = has_hip ? 0 : 1; i < leg_servos.size(); ++i) {
    anchor[i] = models::vector_at(data->xanchor, joint_of(robot, leg_servos[i]));
  }
  const auto links = links_of(robot, *data);
  const auto length_and_centre = [&](std::size_t i) {
    const Eigen::Vector3d along = in_plane(anchor[i + 1] - anchor[i]);
    const Eigen::Vector3d centre = links[i].weighted_centre / links[i].mass - anchor[i];
    return std::pair(along.norm(), along.dot(centre) / along.squaredNorm());
  };
  // Estimators assume the wheel's mass at its axle, so its offset must not add to the inertia.
  const Link& wheel = links[2];
  const double off_axle = in_plane(wheel.weighted_centre / wheel.mass - anchor[2]).norm();
  const double wheel_inertia = inertia_about_axle(robot, *data) - wheel.mass * off_axle * off_axle;
  const auto [lower_length, lower_centre] = length_and_centre(1);
  const auto [upper_length, upper_centre] =
      has_hip ? length_and_centre(0) : std::pair(without_hip * lower_length, 0.0);
  const models::Actuator& hip = robot.actuator[models::index(Servo::left_hip)];
  const models::Actuator& knee = robot.actuator[models::index(Servo::left_knee)];
  return {.upper_length = rounded(upper_length, 1e6),
          .lower_length = rounded(lower_length, 1e6),
          .upper_mass = rounded(links[0].mass, 1e6),
          .lower_mass = rounded(links[1].mass, 1e6),
          .wheel_mass = rounded(links[2].mass, 1e6),
          .upper_centre = rounded(upper_centre, 1e3),
          .lower_centre = rounded(lower_centre, 1e3),
          .wheel_inertia = rounded(wheel_inertia, 1e8),
          .robot_mass = rounded(mj_getTotalmass(robot.mj.get()), 1e6),
          .hip_friction = has_hip ? hip.friction : 0.0,
          .knee_friction = knee.friction,
          .position_resolution = std::max(hip.position_resolution, knee.position_resolution)};
}

}  // namespace touchdown::scenarios
