#include "policies/wheeled_pendulum.hpp"

#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>

#include <Eigen/LU>

#include "core/error.hpp"

namespace touchdown::policies {

namespace {

using Eigen::Vector3d;

/// The mass matrix, and the directions of leaning and rolling in mjData::qvel.
struct Directions {
  Eigen::MatrixXd mass;
  Eigen::VectorXd leaning, rolling;
};

Directions directions(const models::RobotModel& robot, const mjData& data, const Vector3d& ground) {
  const mjModel& mj = *robot.mj;
  Directions d = {Eigen::MatrixXd(mj.nv, mj.nv), Eigen::VectorXd::Zero(mj.nv),
                  Eigen::VectorXd::Zero(mj.nv)};
  mj_fullM(&mj, d.mass.data(), data.qM);  // symmetric, so row or column order does not matter
  // Leaning rotates the robot about the contact line. Rolling moves it on and turns the wheels.
  const int base = robot.base_dof();
  const Vector3d base_from_ground = models::vector_at(data.xpos, robot.base_body) - ground;
  d.leaning.segment<3>(base) = Vector3d::UnitY().cross(base_from_ground);
  d.leaning.segment<3>(base + 3) =
      models::quaternion_at(data.xquat, robot.base_body).conjugate() * Vector3d::UnitY();
  d.rolling[base] = robot.wheel_radius;
  for (const models::Servo wheel : models::wheel_servos) {
    const int dof = robot.dof_address[models::index(wheel)];
    d.rolling[dof] = models::vector_at(data.xaxis, mj.dof_jntid[dof]).y() > 0.0 ? 1.0 : -1.0;
  }
  return d;
}

/// How far forward of the body the axle moves as a leg carries one newton, times the stiffness of
/// hip and knee (N·m²/N).
double bending_per_load(const models::RobotModel& robot, const mjData& data, std::size_t leg) {
  const mjModel& mj = *robot.mj;
  Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor> jacobian(3, mj.nv);
  const int tyre = robot.tyre_geom[leg];
  mj_jac(&mj, &data, jacobian.data(), nullptr, &data.geom_xpos[3 * tyre], mj.geom_bodyid[tyre]);
  Eigen::Matrix<double, 3, 2> axle = Eigen::Matrix<double, 3, 2>::Zero();
  for (std::size_t i = 0; i < 2; ++i) {
    if (!robot.has(3 * leg + i)) continue;
    axle.col(static_cast<Eigen::Index>(i)) = jacobian.col(robot.dof_address[3 * leg + i]);
  }
  if (!robot.closed_leg[leg]) return axle.row(0).dot(axle.row(2));
  // Hip and knee move as the loops let them.
  const models::ClosedLeg& closed = *robot.closed_leg[leg];
  LinkageVector q(closed.linkage.size());
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    q[i] = data.qpos[mj.jnt_qposadr[closed.joint[static_cast<std::size_t>(i)]]];
  }
  const Eigen::MatrixXd v = MotorMap(closed.linkage, q).leg;
  return axle.row(0).dot(v *
                         (v.transpose() * v).ldlt().solve(v.transpose() * axle.row(2).transpose()));
}

}  // namespace

using Eigen::MatrixXd;

LinearSystem sampled(const LinearSystem& continuous, double period) {
  const auto states = continuous.a.rows();
  const auto inputs = continuous.b.cols();
  MatrixXd both = MatrixXd::Zero(states + inputs, states + inputs);
  both.topLeftCorner(states, states) = period * continuous.a;
  both.topRightCorner(states, inputs) = period * continuous.b;
  const MatrixXd step = both.exp();
  return {step.topLeftCorner(states, states), step.topRightCorner(states, inputs)};
}

MatrixXd lqr(const LinearSystem& system, const MatrixXd& q, const MatrixXd& r) {
  // Structure-preserving doubling algorithm: step k covers 2^k samples.
  const MatrixXd identity = MatrixXd::Identity(q.rows(), q.cols());
  MatrixXd a = system.a;
  MatrixXd g = system.b * r.inverse() * system.b.transpose();
  MatrixXd h = q;  // converges to the cost-to-go P
  constexpr int most_doublings = 60;
  for (int doubling = 0; doubling < most_doublings; ++doubling) {
    const MatrixXd inverse = (identity + g * h).inverse();
    const MatrixXd more = a.transpose() * h * inverse * a;
    g += a * inverse * g * a.transpose();
    a = (a * inverse * a).eval();
    h += more;
    if (!h.allFinite()) break;
    if (more.lpNorm<Eigen::Infinity>() <= 1e-14 * h.lpNorm<Eigen::Infinity>()) {
      const MatrixXd bp = system.b.transpose() * h;
      return (r + bp * system.b).ldlt().solve(bp * system.a);
    }
  }
  throw Error("no gains stabilise the linear system");
}

MatrixXd bryson(const Eigen::VectorXd& largest) {
  return largest.cwiseAbs2().cwiseInverse().asDiagonal();
}

WheeledPendulum wheeled_pendulum(const models::RobotModel& robot,
                                 const Eigen::Quaterniond& orientation,
                                 const std::array<double, models::servo_count>& joint_position) {
  const mjModel& mj = *robot.mj;
  const models::MjDataPtr data = models::at_pose(robot, orientation, joint_position);
  const Vector3d left = models::vector_at(data->geom_xpos, robot.tyre_geom[0]);
  const Vector3d right = models::vector_at(data->geom_xpos, robot.tyre_geom[1]);
  const Vector3d axle = 0.5 * (left + right);
  const Vector3d ground = axle - robot.wheel_radius * Vector3d::UnitZ();
  const Vector3d centre = models::vector_at(data->subtree_com, robot.base_body);
  const Directions d = directions(robot, *data, ground);
  const int wheel = robot.dof_address[models::index(models::Servo::left_wheel)];
  const double weight =
      mj.body_subtreemass[robot.base_body] * -models::vector_at(mj.opt.gravity, 0).z();
  const double height = (centre - axle).z();
  return {.inertia = d.leaning.dot(d.mass * d.leaning),
          .coupling = d.leaning.dot(d.mass * d.rolling),
          .gravity = weight * height,
          .wheel_radius = robot.wheel_radius,
          .wheel_inertia = d.mass(wheel, wheel),
          .track = (left - right).norm(),
          .bending = 0.5 * weight * bending_per_load(robot, *data, 0) / height};
}

WheelBalancerConfig with_lqr_gains(WheelBalancerConfig config, const WheeledPendulum& pendulum) {
  if (!(pendulum.gravity > 0.0)) {
    throw InputError("lqr: expected a robot with its centre of mass above its axle");
  }
  // x = (s, θ, ṡ, θ̇), u = s̈: the wheel servos track the acceleration that the law commands, and the
  // law is a state feedback of this acceleration.
  LinearSystem system = {Eigen::MatrixXd::Zero(4, 4), Eigen::MatrixXd::Zero(4, 1)};
  system.a(0, 2) = system.a(1, 3) = 1.0;
  system.a(3, 1) = pendulum.gravity / pendulum.inertia;
  system.b(2, 0) = 1.0;
  system.b(3, 0) = -pendulum.coupling / (pendulum.wheel_radius * pendulum.inertia);
  const Eigen::Vector4d largest_state(1.0, 0.1, 1.0, 1.0);  // m, rad, m/s, rad/s
  const Eigen::Matrix<double, 1, 1> largest_input(1.5);     // m/s²
  constexpr double period = 1e-3;                           // s
  const Eigen::MatrixXd k =
      lqr(sampled(system, period), bryson(largest_state), bryson(largest_input));
  config.position_stiffness = -k(0, 0);
  config.pitch_stiffness = -k(0, 1);
  config.position_damping = -k(0, 2);
  config.pitch_damping = -k(0, 3);

  // The other parameters, in units of g and the pendulum's toppling time T.
  constexpr double g = 9.81;
  const double topple = std::sqrt(pendulum.inertia / pendulum.gravity);
  config.max_velocity = 0.95 * g * topple;
  config.max_integral = 4.75 * g * topple;
  config.leg_kp_scale = 0.157 * pendulum.gravity;  // legs 3 times as stiff as the pull of gravity
  config.leg_kd_scale = 0.73 * pendulum.gravity * topple;
  constexpr double most_lean = 0.03;  // rad, of legs that bend to one side
  const double stiffer = std::max(
      1.0, std::abs(pendulum.bending) / (most_lean * models::servo_kp * config.leg_kp_scale));
  config.leg_kp_scale *= stiffer;
  config.leg_kd_scale *= std::sqrt(stiffer);
  constexpr double spin_up = 0.873e-3;  // s: of a wheel in the air
  config.wheel_kd_scale = pendulum.wheel_inertia / spin_up;
  // The wheel servos resist turning like a damper.
  const double resistance = config.wheel_kd_scale * 0.5 * pendulum.track / pendulum.wheel_radius;
  config.yaw_damping = 0.164 * resistance;
  config.yaw_stiffness = 1.64 * resistance;
  return config;
}

}  // namespace touchdown::policies
