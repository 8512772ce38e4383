#include "policies/servo_stability.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "core/error.hpp"
#include "models/simulated_joints.hpp"

namespace touchdown::policies {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// With torques -K q - D v, held for a step h, an engine's freedoms follow
//
//     M (z - 1)^2 + h D (z - 1) + h^2 K z = 0
//
// The oscillation that alternates at each step, z = -1, is the first to become unstable (with a
// lag, while it is below kd / kp): stable gains leave 4 M - (2 h D + h^2 K) positive definite.

/// 2 h D + h² K of every freedom.
struct Load {
  VectorXd servos, friction;
};

Load load_of(const models::RobotModel& robot, const WheelBalancerConfig& config, double period) {
  Load load = {VectorXd::Zero(robot.mj->nv), VectorXd::Zero(robot.mj->nv)};
  const auto of = [period](double kp, double kd) { return period * (2.0 * kd + period * kp); };
  const auto add_friction = [&](int dof, const models::Actuator& actuator, double viscous) {
    const models::Presliding sticking =
        models::presliding(actuator, 1.0 / robot.mj->dof_invweight0[dof], period);
    load.friction[dof] = of(sticking.stiffness, sticking.damping + viscous);
  };
  for (std::size_t i = 0; i < models::servo_count; ++i) {
    if (!robot.has(i)) continue;
    const bool is_wheel = i % 3 == 2;
    const models::Actuator& actuator = robot.actuator[i];
    if (const int motor = robot.motor_joint[i]; motor >= 0) {
      add_friction(robot.mj->jnt_dofadr[motor], actuator, actuator.viscous);
    }
    const double gain =
        actuator.torque_lag > 0.0 ? -std::expm1(-period / actuator.torque_lag) : 1.0;
    load.servos[robot.dof_address[i]] =
        gain / (2.0 - gain) *  // what the lag lets through of an alternating torque
        of(is_wheel ? 0.0 : models::servo_kp * config.leg_kp_scale,
           models::servo_kd * (is_wheel ? config.wheel_kd_scale : config.leg_kd_scale));
  }
  for (const models::HeldJoint& held : robot.held) {
    const double inertia = 1.0 / robot.mj->dof_invweight0[held.dof_address];
    add_friction(held.dof_address, held.actuator,
                 models::stable_damping(held.actuator.viscous, inertia, period));
    load.servos[held.dof_address] =
        of(models::stable_stiffness(held.kp, models::held_share * inertia, period),
           models::stable_damping(held.kd, models::held_share * inertia, period));
  }
  return load;
}

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The mass matrix that Bullet shows to alternating torques. They turn a rotor as a part of the
/// link that its joint moves; the compensation, a low-pass of accelerations, adds to it.
MatrixXd mass_in_bullet(const mjModel& mj, const mjData& data, MatrixXd mass) {
  constexpr double weight = 2.0 / (2.0 - models::rotor_smoothing);
  for (int dof = 0; dof < mj.nv; ++dof) {
    if (mj.dof_armature[dof] == 0.0) continue;
    Rows turning(3, mj.nv);
    mj_jacBody(&mj, &data, nullptr, turning.data(), mj.dof_bodyid[dof]);
    const VectorXd link = turning.transpose() * models::vector_at(data.xaxis, mj.dof_jntid[dof]);
    mass += weight * mj.dof_armature[dof] * link * link.transpose();
    mass(dof, dof) -= weight * mj.dof_armature[dof];
  }
  return mass;
}

/// The velocities, by columns, with closed loops, and with both tyres rolling if it stands.
MatrixXd possible(const models::RobotModel& robot, const mjData& data, bool stands) {
  const mjModel& mj = *robot.mj;
  Rows held = Rows::Zero(3 * (mj.neq + static_cast<int>(models::wheel_count)), mj.nv);
  const auto velocity = [&](int body, const Eigen::Vector3d& point) {
    Rows rows(3, mj.nv);
    mj_jac(&mj, &data, rows.data(), nullptr, point.data(), body);
    return rows;
  };
  for (int loop = 0; loop < mj.neq; ++loop) {
    const int body = mj.eq_obj1id[loop];
    const Eigen::Vector3d point = models::vector_at(data.xpos, body) +
                                  models::quaternion_at(data.xquat, body) *
                                      models::vector_at(&mj.eq_data[mjNEQDATA * loop], 0);
    held.middleRows<3>(3 * loop) = velocity(body, point) - velocity(mj.eq_obj2id[loop], point);
  }
  for (std::size_t wheel = 0; stands && wheel < models::wheel_count; ++wheel) {
    const int tyre = robot.tyre_geom[wheel];
    held.middleRows<3>(3 * (mj.neq + static_cast<int>(wheel))) =
        velocity(mj.geom_bodyid[tyre], models::vector_at(data.geom_xpos, tyre) -
                                           robot.wheel_radius * Eigen::Vector3d::UnitZ());
  }
  Eigen::FullPivLU<MatrixXd> lu(held);
  lu.setThreshold(1e-6);  // two tyres on one axle constrain sideways motion twice
  return lu.kernel();
}

double margin(const MatrixXd& motion, const MatrixXd& mass, const Load& load) {
  const MatrixXd room =
      motion.transpose() * (4.0 * mass - MatrixXd(load.friction.asDiagonal())) * motion;
  if (room.llt().info() != Eigen::Success) return 0.0;
  const MatrixXd used = motion.transpose() * load.servos.asDiagonal() * motion;
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> shares(used, room,
                                                                  Eigen::EigenvaluesOnly);
  return 1.0 / std::max(0.01, shares.eigenvalues().maxCoeff());
}

/// What margins follow from besides the gains.
class ServoStudy {
 public:
  ServoStudy(const models::RobotModel& robot, const ServoPose& pose)
      : robot_(robot), period_(pose.period), mass_(robot.mj->nv, robot.mj->nv) {
    const mjModel& mj = *robot.mj;
    const models::MjDataPtr data = models::at_pose(robot, pose.orientation, pose.joint_position);
    mj_fullM(&mj, mass_.data(), data->qM);
    in_bullet_ = mass_in_bullet(mj, *data, mass_);
    in_flight_ = possible(robot, *data, false);
    standing_ = possible(robot, *data, true);
  }

  ServoMargins margins(const WheelBalancerConfig& config) const {
    const Load load = load_of(robot_, config, period_);
    const auto least = [&](const MatrixXd& motion) {
      return std::min(margin(motion, mass_, load), margin(motion, in_bullet_, load));
    };
    return {least(in_flight_), least(standing_)};
  }

 private:
  const models::RobotModel& robot_;
  double period_;
  MatrixXd mass_, in_bullet_;
  MatrixXd in_flight_, standing_;  ///< possible velocities
};

}  // namespace

ServoMargins servo_margins(const models::RobotModel& robot, const ServoPose& pose,
                           const WheelBalancerConfig& config) {
  return ServoStudy(robot, pose).margins(config);
}

WheelBalancerConfig with_stable_servos(const WheelBalancerConfig& config,
                                       const models::RobotModel& robot, const ServoPose& pose) {
  const ServoStudy study(robot, pose);
  const auto scaled = [&](double legs, double wheels) {
    WheelBalancerConfig lower = config;
    lower.leg_kd_scale *= legs;
    // Legs sag less with their stiffness, which short steps bear longer than damping.
    lower.leg_kp_scale *= std::min(1.0, 4.0 * legs);
    lower.wheel_kd_scale *= wheels;
    lower.yaw_stiffness *= wheels;
    lower.yaw_damping *= wheels;
    return lower;
  };
  const auto allowed = [&](double legs, double wheels) {
    double factor = 1.0;
    while (true) {
      const ServoMargins margins = study.margins(scaled(factor * legs, factor * wheels));
      const double least = std::min(margins.flight, margins.standing);
      if (least >= least_servo_margin) return factor;
      factor *= 0.99 * least / least_servo_margin;
      if (factor < 1e-3) {
        throw InputError(
            "lqr: no gains are stable at this physics step: held joints, friction, or in Bullet an "
            "armature far above the inertia of the joint's parent");
      }
    }
  };
  const double legs = allowed(1.0, 0.0);
  const double wheels = allowed(0.0, 1.0);
  const double both = allowed(legs, wheels);
  return scaled(both * legs, both * wheels);
}

}  // namespace touchdown::policies
