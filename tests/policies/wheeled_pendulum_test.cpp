#include "policies/wheeled_pendulum.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "models/resizing.hpp"
#include "policies/servo_stability.hpp"

namespace touchdown::policies {
namespace {

using Eigen::MatrixXd;
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
  const WheelBalancerConfig by_hand{.max_acceleration = 0.3, .keep_heading = true};
  const WheelBalancerConfig lqr = with_lqr_gains(by_hand, pendulum_of(upkie()));
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
  EXPECT_TRUE(lqr.keep_heading) << "not the robot's";
  EXPECT_EQ(lqr.max_acceleration, 0.3);
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

TEST(LqrGains, OfARobotThatHangsBelowItsAxleAreRefused) {
  const Eigen::Quaterniond upside_down(0.0, 0.0, 1.0, 0.0);
  const WheeledPendulum hangs = wheeled_pendulum(upkie(), upside_down, default_stance);
  EXPECT_THROW((void)with_lqr_gains({}, hangs), InputError);
}

/// Upkie with a heavier base, and the same legs.
models::RobotModel with_base_of(double mass) {
  models::RobotModel robot = upkie();
  robot.mj->body_mass[robot.base_body] = mass;
  models::recompute(*robot.mj);
  return robot;
}

/// The share of steps of a free fall in which a hip's torque changes its sign, by MuJoCo's own
/// integration. Torques approach the law's by `lag_gain` per step.
double sign_changes(const models::RobotModel& robot, const WheelBalancerConfig& config,
                    double lag_gain = 1.0) {
  const mjModel& mj = *robot.mj;
  const models::MjDataPtr data(mj_makeData(&mj));
  models::write_pose(robot, {0, 0, 5}, Eigen::Quaterniond::Identity(), default_stance, data->qpos);
  data->qvel[robot.dof_address[0]] = 0.1;
  constexpr int steps = 400;
  int changes = 0;
  double last = 0.0;
  for (int step = 0; step < steps; ++step) {
    for (std::size_t i = 0; i < models::servo_count; ++i) {
      const bool is_wheel = i % 3 == 2;
      const double velocity = data->qvel[robot.dof_address[i]];
      const double torque =
          is_wheel ? -models::servo_kd * config.wheel_kd_scale * velocity
                   : models::servo_kp * config.leg_kp_scale *
                             (default_stance.at(i) - data->qpos[robot.qpos_address[i]]) -
                         models::servo_kd * config.leg_kd_scale * velocity;
      double& applied = data->qfrc_applied[robot.dof_address[i]];
      applied += lag_gain * (std::clamp(torque, -robot.effort[i], robot.effort[i]) - applied);
    }
    const double torque = data->qfrc_applied[robot.dof_address[0]];
    if (torque * last < 0.0) ++changes;
    last = torque;
    mj_step(&mj, data.get());
  }
  return static_cast<double>(changes) / steps;
}

const ServoPose at_rest{Eigen::Quaterniond::Identity(), default_stance, 1e-3};

TEST(StableServos, OfUpkieKeepTheirGains) {
  const models::RobotModel robot = upkie();
  const WheelBalancerConfig derived = with_lqr_gains({}, pendulum_of(robot));
  const WheelBalancerConfig stable = with_stable_servos(derived, robot, at_rest);
  EXPECT_EQ(stable.leg_kp_scale, derived.leg_kp_scale);
  EXPECT_EQ(stable.leg_kd_scale, derived.leg_kd_scale);
  EXPECT_EQ(stable.wheel_kd_scale, derived.wheel_kd_scale);
}

TEST(StableServos, DoNotChatterInFlightHoweverHeavyTheBase) {
  for (const double mass : {12.0, 25.0, 60.0}) {
    const models::RobotModel robot = with_base_of(mass);
    const WheelBalancerConfig derived = with_lqr_gains({}, pendulum_of(robot));
    const WheelBalancerConfig stable = with_stable_servos(derived, robot, at_rest);
    EXPECT_LT(sign_changes(robot, stable), 0.2) << mass;
  }
  const models::RobotModel heavy = with_base_of(60.0);
  EXPECT_GT(sign_changes(heavy, with_lqr_gains({}, pendulum_of(heavy))), 0.8) << "without it";
}

TEST(ServoMargins, AreTheFactorAtWhichMuJoCoBecomesUnstable) {
  for (const auto& [mass, lag] :
       {std::pair{3.0, 0.0}, std::pair{17.0, 0.0}, std::pair{8.0, 7e-4}}) {
    models::RobotModel robot = with_base_of(mass);
    for (models::Actuator& actuator : robot.actuator) actuator.torque_lag = lag;
    const double lag_gain = lag > 0.0 ? 1.0 - std::exp(-at_rest.period / lag) : 1.0;
    const WheelBalancerConfig config;
    const double margin = servo_margins(robot, at_rest, config).flight;
    const auto changes = [&](double factor) {
      WheelBalancerConfig scaled = config;
      scaled.leg_kp_scale *= factor;
      scaled.leg_kd_scale *= factor;
      scaled.wheel_kd_scale *= factor;
      return sign_changes(robot, scaled, lag_gain);
    };
    EXPECT_LT(changes(0.9 * margin), 0.9) << mass;
    EXPECT_GT(changes(1.1 * margin), 0.9) << mass;
  }
}

TEST(StableServos, HaveTheirMarginAtLongStepsAndWithRotors) {
  for (const auto& [step, armature] :
       {std::pair{5e-3, 0.0}, std::pair{1e-3, 0.03}, std::pair{2e-3, 0.007}}) {
    models::RobotModel robot = with_base_of(25.0);
    for (const int dof : robot.dof_address) robot.mj->dof_armature[dof] = armature;
    models::recompute(*robot.mj);
    ServoPose slow = at_rest;
    slow.period = step;
    const WheelBalancerConfig derived = with_lqr_gains({}, pendulum_of(robot));
    const WheelBalancerConfig stable = with_stable_servos(derived, robot, slow);
    const ServoMargins margins = servo_margins(robot, slow, stable);
    EXPECT_GE(margins.flight, 0.999 * least_servo_margin);
    EXPECT_GE(margins.standing, 0.999 * least_servo_margin);
    EXPECT_LT(servo_margins(robot, slow, derived).flight, 1.0) << "without it";
    EXPECT_NEAR(stable.yaw_damping / stable.wheel_kd_scale,
                derived.yaw_damping / derived.wheel_kd_scale, 1e-9);
  }
}

MatrixXd matrix(int rows, int columns, std::initializer_list<double> values) {
  MatrixXd m(rows, columns);
  auto value = values.begin();
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) m(i, j) = *value++;
  }
  return m;
}

LinearSystem double_integrator() { return {matrix(2, 2, {0, 1, 0, 0}), matrix(2, 1, {0, 1})}; }

/// s, θ, ṡ, θ̇ of something like Upkie.
LinearSystem pendulum() {
  return {matrix(4, 4, {0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 21.8, 0, 0}),
          matrix(4, 1, {0, 0, 1, -2.7})};
}

/// Riccati's recursion, one sample after the other.
MatrixXd by_value_iteration(const LinearSystem& system, const MatrixXd& q, const MatrixXd& r,
                            int samples) {
  MatrixXd p = q;
  MatrixXd k;
  for (int i = 0; i < samples; ++i) {
    k = (r + system.b.transpose() * p * system.b).inverse() * system.b.transpose() * p * system.a;
    p = (q + system.a.transpose() * p * (system.a - system.b * k)).eval();
  }
  return k;
}

TEST(Sampled, ADoubleIntegratorMovesAsInSchool) {
  const LinearSystem sampled_system = sampled(double_integrator(), 0.1);
  EXPECT_TRUE(sampled_system.a.isApprox(matrix(2, 2, {1, 0.1, 0, 1}), 1e-14));
  EXPECT_TRUE(sampled_system.b.isApprox(matrix(2, 1, {0.005, 0.1}), 1e-14));
}

TEST(Sampled, APendulumTopplesHyperbolically) {
  const double w = std::sqrt(21.8);
  const LinearSystem step = sampled(pendulum(), 0.2);
  EXPECT_NEAR(step.a(1, 1), std::cosh(0.2 * w), 1e-12);
  EXPECT_NEAR(step.a(3, 1), w * std::sinh(0.2 * w), 1e-12);
  EXPECT_NEAR(step.b(1, 0), -2.7 * (std::cosh(0.2 * w) - 1.0) / 21.8, 1e-12);
}

TEST(Lqr, OfOneStateIsTheRootOfAQuadratic) {
  const double a = 1.1, b = 0.5, q = 2.0, r = 3.0;
  // b²p² + (r − a²r − b²q)p − qr = 0
  const double half = 0.5 * (r - a * a * r - b * b * q);
  const double p = (-half + std::sqrt(half * half + b * b * q * r)) / (b * b);
  const MatrixXd k =
      lqr({matrix(1, 1, {a}), matrix(1, 1, {b})}, matrix(1, 1, {q}), matrix(1, 1, {r}));
  EXPECT_NEAR(k(0, 0), a * b * p / (r + b * b * p), 1e-13);
}

TEST(Lqr, OfAFastSampledDoubleIntegratorIsTheContinuousOne) {
  // k₁ = u/s, k₂ = √(2u/s + u²/v²)
  const double s = 0.5, v = 2.0, u = 3.0;
  const MatrixXd k = lqr(sampled(double_integrator(), 1e-5), bryson(Eigen::Vector2d(s, v)),
                         bryson(Eigen::VectorXd::Constant(1, u)));
  EXPECT_NEAR(k(0, 0), u / s, 1e-3);
  EXPECT_NEAR(k(0, 1), std::sqrt(2.0 * u / s + u * u / (v * v)), 1e-3);
}

TEST(Lqr, IsWhereRiccatisRecursionEnds) {
  const MatrixXd q = bryson(Eigen::Vector4d(1.0, 0.1, 1.0, 1.0));
  const MatrixXd r = bryson(Eigen::VectorXd::Constant(1, 1.5));
  for (const double sampling : {1e-3, 5e-3}) {
    const LinearSystem system = sampled(pendulum(), sampling);
    const MatrixXd k = lqr(system, q, r);
    EXPECT_TRUE(k.isApprox(by_value_iteration(system, q, r, 40'000), 1e-6)) << k;
    MatrixXd motion = system.a - system.b * k;
    for (int i = 0; i < 17; ++i) motion = (motion * motion).eval();
    EXPECT_LT(motion.norm(), 1e-6) << "all motions have faded after 131072 samples";
  }
}

TEST(Lqr, RefusesASystemThatCannotBeStabilised) {
  // The unstable state is out of reach.
  EXPECT_THROW((void)lqr({matrix(2, 2, {1.1, 0, 0, 0.5}), matrix(2, 1, {0, 1})},
                         MatrixXd::Identity(2, 2), MatrixXd::Identity(1, 1)),
               Error);
}

}  // namespace
}  // namespace touchdown::policies
