#include "scenarios/leg_geometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace touchdown::scenarios {

namespace {

using models::Servo;

constexpr std::array<Servo, 3> leg_servos = {Servo::left_hip, Servo::left_knee, Servo::left_wheel};
constexpr std::array<Servo, 3> right_servos = {Servo::right_hip, Servo::right_knee,
                                               Servo::right_wheel};
using LegServos = std::array<Servo, 3>;

/// The bodies that one of the leg's joints moves and the next joint does not.
struct Link {
  double mass = 0.0;                                          ///< kg
  Eigen::Vector3d weighted_centre = Eigen::Vector3d::Zero();  ///< kg·m
  std::vector<int> bodies;

  Eigen::Vector3d centre() const { return weighted_centre / mass; }
};

int joint_of(const models::RobotModel& robot, Servo servo) {
  return robot.joint[models::index(servo)];
}

std::array<Link, leg_servos.size()> links_of(const models::RobotModel& robot, const mjData& data,
                                             const LegServos& servos) {
  const mjModel& mj = *robot.mj;
  std::array<Link, leg_servos.size()> links;
  for (int body = 1; body < mj.nbody; ++body) {
    for (int above = body; above > 0; above = mj.body_parentid[above]) {
      const int joint = mj.body_jntnum[above] > 0 ? mj.body_jntadr[above] : -1;
      const auto mover = std::find_if(servos.begin(), servos.end(),
                                      [&](Servo servo) { return joint_of(robot, servo) == joint; });
      if (joint < 0) continue;  // fixed to the body above
      if (mover != servos.end()) {
        Link& link = links[static_cast<std::size_t>(mover - servos.begin())];
        link.mass += mj.body_mass[body];
        link.weighted_centre += mj.body_mass[body] * models::vector_at(data.xipos, body);
        link.bodies.push_back(body);
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

/// Inertia of a link about an axis through its centre of mass (kg·m²).
double inertia_of(const Link& link, const models::RobotModel& robot, const mjData& data,
                  const Eigen::Vector3d& axis) {
  using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  double inertia = 0.0;
  for (const int body : link.bodies) {
    const Eigen::Vector3d along =
        Eigen::Map<const RowMajor>(data.ximat + 9 * body).transpose() * axis;
    const Eigen::Vector3d arm = axis.cross(models::vector_at(data.xipos, body) - link.centre());
    inertia += along.cwiseAbs2().dot(models::vector_at(robot.mj->body_inertia, body)) +
               robot.mj->body_mass[body] * arm.squaredNorm();
  }
  return inertia;
}

/// Of a leg's centre of mass, to the left in the base (m).
double sideways(const std::array<Link, leg_servos.size()>& links) {
  Link leg;
  for (const Link& link : links) {
    leg.mass += link.mass;
    leg.weighted_centre += link.weighted_centre;
  }
  return leg.centre().y();
}

/// The motor at a joint. The motors of closed legs are elsewhere.
struct Motor {
  double armature = 0.0;
  double viscous = 0.0;
  double torque_limit = no_torque_limit;
};

Motor motor_at(const models::RobotModel& robot, Servo servo) {
  const std::size_t i = models::index(servo);
  if (!robot.has(i) || robot.motor_joint[i] != robot.joint[i]) return {};
  return {.armature = robot.mj->dof_armature[robot.dof_address[i]],
          .viscous = robot.actuator[i].viscous,
          .torque_limit =
              std::min({robot.effort[i], robot.actuator[i].maximum_torque, no_torque_limit})};
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
  const auto links = links_of(robot, *data, leg_servos);
  const auto length_and_centre = [&](std::size_t i) {
    const Eigen::Vector3d along = in_plane(anchor[i + 1] - anchor[i]);
    const Eigen::Vector3d centre = links[i].centre() - anchor[i];
    return std::pair(along.norm(), along.dot(centre) / along.squaredNorm());
  };
  // Estimators assume the wheel's mass at its axle, so its offset must not add to the inertia.
  const Link& wheel = links[2];
  const double off_axle = in_plane(wheel.centre() - anchor[2]).norm();
  const double wheel_inertia = inertia_about_axle(robot, *data) - wheel.mass * off_axle * off_axle;
  const auto [lower_length, lower_centre] = length_and_centre(1);
  const auto [upper_length, upper_centre] =
      has_hip ? length_and_centre(0) : std::pair(without_hip * lower_length, 0.0);
  const models::Actuator& hip = robot.actuator[models::index(Servo::left_hip)];
  const models::Actuator& knee = robot.actuator[models::index(Servo::left_knee)];
  const Motor of_hip = motor_at(robot, leg_servos[0]);
  const Motor of_knee = motor_at(robot, leg_servos[1]);
  const Motor of_wheel = motor_at(robot, leg_servos[2]);
  const Eigen::Vector3d from_imu = anchor[has_hip ? 0 : 1] - robot.imu_position;
  const double apart = sideways(links) - sideways(links_of(robot, *data, right_servos));
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
          .upper_inertia = has_hip ? rounded(inertia_of(links[0], robot, *data, axis), 1e8) : 0.0,
          .lower_inertia = rounded(inertia_of(links[1], robot, *data, axis), 1e8),
          .hip_armature = rounded(of_hip.armature, 1e8),
          .knee_armature = rounded(of_knee.armature, 1e8),
          .wheel_armature = rounded(of_wheel.armature, 1e8),
          .hip_viscous = of_hip.viscous,
          .knee_viscous = of_knee.viscous,
          .wheel_viscous = of_wheel.viscous,
          .hip_torque_limit = of_hip.torque_limit,
          .knee_torque_limit = of_knee.torque_limit,
          .wheel_torque_limit = of_wheel.torque_limit,
          .hip_forward = rounded(from_imu.x(), 1e6),
          .hip_upward = rounded(from_imu.z(), 1e6),
          .leg_sideways = rounded(0.5 * apart, 1e6)};
}

}  // namespace touchdown::scenarios
