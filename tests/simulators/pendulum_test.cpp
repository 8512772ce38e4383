#include "tests/simulators/upkie.hpp"

namespace touchdown::simulators {
namespace {

/// Makes the base so heavy that a force equal to its weight holds it in place.
void hold_base(models::RobotModel& robot) { make_heavy(robot, robot.base_body); }

ExternalWrench base_weight(const models::RobotModel& robot) {
  const int base = robot.base_body;
  return {Eigen::Vector3d(0.0, 0.0, g * robot.mj->body_mass[base]),
          models::vector_at(robot.mj->body_ipos, base)};
}

TEST(Pendulum, SwingsEquallyInBothEngines) {
  const auto model = upkie(hold_base);
  const auto mujoco = make_simulator("mujoco", model, {});
  const auto bullet = make_simulator("bullet", model, {});
  RobotState start = at_height(5.0);
  start.joint_position = {0.5, -0.4, 0.0, 0.3, 0.2, 0.0};
  mujoco->reset(start);
  bullet->reset(start);
  double largest = 0.0;
  double swing = 0.0;
  for (int i = 0; i < 2000; ++i) {
    mujoco->step(torques(), base_weight(*model));
    bullet->step(torques(), base_weight(*model));
    for (std::size_t j = 0; j < models::servo_count; ++j) {
      const double velocity = mujoco->state().joint_velocity[j];
      largest = std::max(largest, std::abs(velocity - bullet->state().joint_velocity[j]));
      swing = std::max(swing, std::abs(velocity));
    }
  }
  EXPECT_GT(swing, 1.0);
  EXPECT_LT(largest, 1e-9);
}

/// A compound pendulum: the left lower leg with the wheel's mass at its end. The wheel's centre of
/// mass is on its axle, so the wheel does not turn with the leg.
struct CompoundPendulum {
  double stiffness;  ///< g·(m·l of all parts) over the inertia about the knee (1/s²)
  double offset;     ///< angle of the centre of mass ahead of straight down (rad)

  explicit CompoundPendulum(const models::RobotModel& robot) {
    const mjModel& mj = *robot.mj;
    const int wheel = mj.geom_bodyid[robot.tyre_geom[0]];
    const int leg = mj.body_parentid[wheel];
    const Eigen::Vector3d leg_com = models::vector_at(mj.body_ipos, leg);
    const Eigen::Vector3d wheel_com =
        models::vector_at(mj.body_pos, wheel) + models::vector_at(mj.body_ipos, wheel);
    const Eigen::Matrix3d axes = models::quaternion_at(mj.body_iquat, leg).toRotationMatrix();
    const Eigen::Matrix3d own =
        axes * models::vector_at(mj.body_inertia, leg).asDiagonal() * axes.transpose();
    const auto arm2 = [](const Eigen::Vector3d& p) { return p.x() * p.x() + p.z() * p.z(); };
    const double inertia =
        own(1, 1) + mj.body_mass[leg] * arm2(leg_com) + mj.body_mass[wheel] * arm2(wheel_com);
    const Eigen::Vector3d moment = mj.body_mass[leg] * leg_com + mj.body_mass[wheel] * wheel_com;
    stiffness = g * std::hypot(moment.x(), moment.z()) / inertia;
    offset = std::atan2(moment.x(), -moment.z());
  }

  double acceleration(double angle) const { return -stiffness * std::sin(angle + offset); }
};

/// Angle and rate after `seconds` by the classic fourth-order method.
std::pair<double, double> runge_kutta(const CompoundPendulum& pendulum, double angle,
                                      double seconds) {
  const int steps = 20'000;
  const double h = seconds / steps;
  double rate = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double k1 = pendulum.acceleration(angle);
    const double k2 = pendulum.acceleration(angle + 0.5 * h * rate);
    const double k3 = pendulum.acceleration(angle + 0.5 * h * rate + 0.25 * h * h * k1);
    const double k4 = pendulum.acceleration(angle + h * rate + 0.5 * h * h * k2);
    angle += h * rate + h * h / 6.0 * (k1 + k2 + k3);
    rate += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  return {angle, rate};
}

class LowerLeg : public EveryEngine {
 protected:
  /// Holds base and upper legs: the upper legs balance on their hips and are too heavy to turn.
  static void hold_all_above(models::RobotModel& robot) {
    hold_base(robot);
    for (const int tyre : robot.tyre_geom) {
      const int wheel = robot.mj->geom_bodyid[tyre];
      const int upper_leg = robot.mj->body_parentid[robot.mj->body_parentid[wheel]];
      make_heavy(robot, upper_leg);
      for (int i = 0; i < 3; ++i) robot.mj->body_ipos[3 * upper_leg + i] = 0.0;
      robot.mj->body_ipos[3 * wheel] = 0.0;
      robot.mj->body_ipos[3 * wheel + 2] = 0.0;
    }
  }

  static ExternalWrench weight(const models::RobotModel& robot) {
    ExternalWrench wrench = base_weight(robot);
    const Eigen::Vector3d base = wrench.point_in_base;
    // The upper legs hang below the hips: pull at the common centre of mass.
    const Eigen::Vector3d hips(0.0, 0.0, -0.164);
    wrench.force *= 3.0;
    wrench.point_in_base = (base + 2.0 * hips) / 3.0;
    return wrench;
  }
};

TEST_P(LowerLeg, SwingsLikeACompoundPendulum) {
  const auto model = upkie(hold_all_above);
  const CompoundPendulum pendulum(*model);
  const double seconds = 1.0;
  const auto simulator = make(model, steps_of(20));
  RobotState start = at_height(5.0);
  start.joint_position[models::index(models::Servo::left_knee)] = 0.8;
  simulator->reset(start);
  // The same equation by semi-implicit Euler, as in the engines.
  double angle = 0.8;
  double rate = 0.0;
  const double h = simulator->control_period();
  const auto steps = std::lround(seconds / h);
  double fastest = 0.0;
  for (long i = 0; i < steps; ++i) {
    simulator->step(torques(), weight(*model));
    rate += h * pendulum.acceleration(angle);
    angle += h * rate;
    fastest = std::max(fastest, std::abs(rate));
  }
  const double swung = simulator->state().joint_position[models::index(models::Servo::left_knee)];
  const double swinging =
      simulator->state().joint_velocity[models::index(models::Servo::left_knee)];
  EXPECT_NEAR(swung, angle, 1e-6);
  EXPECT_NEAR(swinging, rate, 1e-6 * fastest);
  const auto [exact_angle, exact_rate] = runge_kutta(pendulum, 0.8, seconds);
  EXPECT_NEAR(swung, exact_angle, 1e-3);
  EXPECT_NEAR(swinging, exact_rate, 1e-3 * fastest);
}

INSTANTIATE_TEST_SUITE_P(Engine, LowerLeg, ::testing::ValuesIn(simulator_names()), engine_name);

}  // namespace
}  // namespace touchdown::simulators
