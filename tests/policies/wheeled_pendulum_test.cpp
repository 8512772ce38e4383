#include "policies/wheeled_pendulum.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "models/resizing.hpp"

namespace touchdown::policies {
namespace {

using models::vector_at;

// Upkie's default stance, in which it balances with the torso upright to a thousandth.
constexpr std::array<double, models::servo_count> default_stance = {0.455,  -0.791, 0.0,
                                                                    -0.455, 0.791,  0.0};

models::RobotModel upkie() {
  return models::compile_robot_model(TOUCHDOWN_SOURCE_DIR "/models/upkie.xml", {});
}

WheeledPendulum pendulum_of(const models::RobotModel& robot) {
  return wheeled_pendulum(robot, Eigen::Quaterniond::Identity(), default_stance);
}

TEST(WheeledPendulum, OfUpkieIsTheSumOverItsBodies) {
  const models::RobotModel robot = upkie();
  const mjModel& mj = *robot.mj;
  const models::MjDataPtr data(mj_makeData(&mj));
  models::write_pose(robot, {0, 0, 0}, Eigen::Quaterniond::Identity(), default_stance, data->qpos);
  mj_forward(&mj, data.get());
  const Eigen::Vector3d axle = vector_at(data->geom_xpos, robot.tyre_geom[0]);
  // D is the inertia about the line on the ground below the axle. In C the wheels move the same way
  // when they roll and when all leans; everything else moves on.
  double inertia = 0.0;
  double coupling = 0.0;
  double gravity = 0.0;
  for (int body = 1; body < mj.nbody; ++body) {
    const Eigen::Matrix3d axes =
        Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(data->ximat + 9 * body);
    const double own =
        (axes * vector_at(mj.body_inertia, body).asDiagonal() * axes.transpose())(1, 1);
    const Eigen::Vector3d at = vector_at(data->xipos, body) - axle;
    const double mass = mj.body_mass[body];
    const bool is_wheel =
        body == mj.geom_bodyid[robot.tyre_geom[0]] || body == mj.geom_bodyid[robot.tyre_geom[1]];
    inertia += own + mass * (at.x() * at.x() + (at.z() + 0.05) * (at.z() + 0.05));
    coupling += is_wheel ? own + mass * (at.x() * at.x() + (at.z() + 0.05) * (at.z() + 0.05))
                         : 0.05 * mass * (at.z() + 0.05);
    gravity += 9.81 * mass * at.z();
  }
  const WheeledPendulum pendulum = pendulum_of(robot);
  EXPECT_NEAR(pendulum.inertia, inertia, 1e-9);
  EXPECT_NEAR(pendulum.coupling, coupling, 1e-9);
  EXPECT_NEAR(pendulum.gravity, gravity, 1e-9);
  EXPECT_EQ(pendulum.wheel_radius, 0.05);
  EXPECT_NEAR(pendulum.wheel_inertia, 1.7456e-4, 1e-7);
  EXPECT_NEAR(pendulum.track, 2.0 * (0.1142 + 0.0962 - 0.012 - 0.046), 1e-9);
  // By hand, from the masses of the official description.
  EXPECT_NEAR(pendulum.inertia, 0.587, 0.003);
  EXPECT_NEAR(pendulum.gravity, 12.78, 0.05);
}

TEST(WheeledPendulum, CountsTheWheelsRotors) {
  models::RobotModel robot = upkie();
  robot.mj->dof_armature[robot.dof_address[models::index(models::Servo::left_wheel)]] = 1e-3;
  models::recompute(*robot.mj);
  EXPECT_NEAR(pendulum_of(robot).wheel_inertia, 1.7456e-4 + 1e-3, 1e-7);
}

TEST(LqrGains, OfUpkieAreNearThoseFoundByHand) {
  const WheelBalancerConfig by_hand;
  const WheelBalancerConfig lqr = with_lqr_gains({}, pendulum_of(upkie()));
  EXPECT_NEAR(lqr.pitch_stiffness, by_hand.pitch_stiffness, 0.05 * by_hand.pitch_stiffness);
  EXPECT_NEAR(lqr.pitch_damping, by_hand.pitch_damping, 0.2 * by_hand.pitch_damping);
  EXPECT_NEAR(lqr.position_stiffness, by_hand.position_stiffness, 0.05);
  EXPECT_NEAR(lqr.position_damping, by_hand.position_damping, 0.2 * by_hand.position_damping);
  // In proportion to these everything else is.
  EXPECT_NEAR(lqr.max_velocity, by_hand.max_velocity, 0.02);
  EXPECT_NEAR(lqr.wheel_kd_scale, by_hand.wheel_kd_scale, 0.001);
  EXPECT_NEAR(lqr.yaw_stiffness, by_hand.yaw_stiffness, 0.01);
  EXPECT_NEAR(lqr.yaw_damping, by_hand.yaw_damping, 0.001);
  EXPECT_NEAR(lqr.leg_kp_scale, by_hand.leg_kp_scale, 0.02);
  EXPECT_NEAR(lqr.leg_kd_scale, by_hand.leg_kd_scale, 0.02);
}

TEST(LqrGains, OfAHeavierRobotAskForTheSameMotionWithMoreTorque) {
  models::RobotModel robot = upkie();
  const WheelBalancerConfig light = with_lqr_gains({}, pendulum_of(robot));
  models::scale_mass(*robot.mj, 2.0);
  models::recompute(*robot.mj);
  const WheelBalancerConfig heavy = with_lqr_gains({}, pendulum_of(robot));
  EXPECT_NEAR(heavy.pitch_stiffness, light.pitch_stiffness, 1e-9);
  EXPECT_NEAR(heavy.position_damping, light.position_damping, 1e-9);
  EXPECT_NEAR(heavy.max_velocity, light.max_velocity, 1e-9);
  EXPECT_NEAR(heavy.wheel_kd_scale, 2.0 * light.wheel_kd_scale, 1e-9);
  EXPECT_NEAR(heavy.yaw_stiffness, 2.0 * light.yaw_stiffness, 1e-9);
  EXPECT_NEAR(heavy.leg_kp_scale, 2.0 * light.leg_kp_scale, 1e-9);
}

TEST(LqrGains, LeaveWhatIsNotTheRobots) {
  WheelBalancerConfig config;
  config.keep_heading = true;
  config.max_acceleration = 0.3;
  const WheelBalancerConfig lqr = with_lqr_gains(config, pendulum_of(upkie()));
  EXPECT_TRUE(lqr.keep_heading);
  EXPECT_EQ(lqr.max_acceleration, 0.3);
}

TEST(LqrGains, OfARobotThatHangsBelowItsAxleAreRefused) {
  const Eigen::Quaterniond upside_down(0.0, 0.0, 1.0, 0.0);
  const WheeledPendulum hangs = wheeled_pendulum(upkie(), upside_down, default_stance);
  EXPECT_THROW((void)with_lqr_gains({}, hangs), InputError);
}

}  // namespace
}  // namespace touchdown::policies
