#pragma once

#include <Eigen/Core>

#include "models/robot_model.hpp"
#include "policies/commands.hpp"

namespace touchdown::policies {

/// Continuous, ẋ = A x + B u, or discrete, x′ = A x + B u.
struct LinearSystem {
  Eigen::MatrixXd a, b;
};

/// Discretises a continuous system with sampling `period` (s) and zero-order hold of u.
LinearSystem sampled(const LinearSystem& continuous, double period);

/// The gains K of u = −K x that minimise Σ xᵀQx + uᵀRu over a sampled system, from the discrete
/// algebraic Riccati equation. Errors: `Error` if the system cannot be stabilised.
Eigen::MatrixXd lqr(const LinearSystem& system, const Eigen::MatrixXd& q, const Eigen::MatrixXd& r);

/// Weights by Bryson's rule: the inverse squares of the largest acceptable values.
Eigen::MatrixXd bryson(const Eigen::VectorXd& largest);

/// A wheeled biped with stiff legs, from the side. It leans by θ; its wheel joints have turned by
/// ψ, so that wheel odometry gives s = r·ψ. Near the upright pose, for any wheel torque,
///
///     D·θ̈ + (C/r)·s̈ = G·θ
///
/// This is the sum of the equations of wheels and body, in which the torques cancel.
struct WheeledPendulum {
  double inertia = 0.0;        ///< D, of the whole robot about its contact line (kg·m²)
  double coupling = 0.0;       ///< C, between leaning and rolling (kg·m²)
  double gravity = 0.0;        ///< G, the torque of gravity per radian of leaning (N·m/rad)
  double wheel_radius = 0.0;   ///< r (m)
  double wheel_inertia = 0.0;  ///< of one wheel about its axle, with its rotor (kg·m²)
  double track = 0.0;          ///< between the tyres (m)
  /// Lean of the body, times the stiffness of hips and knees (N·m), as its weight bends the legs.
  double bending = 0.0;
};

/// The pendulum model of a robot in a balanced pose with heading +x.
WheeledPendulum wheeled_pendulum(const models::RobotModel& robot,
                                 const Eigen::Quaterniond& orientation,
                                 const std::array<double, models::servo_count>& joint_position);

/// Computes the balancer's parameters for this pendulum. The four gains on pitch and position come
/// from LQR; the others scale with the robot's physics. The proportions are such that Upkie in its
/// default stance gets its hand-tuned gains.
WheelBalancerConfig with_lqr_gains(WheelBalancerConfig config, const WheeledPendulum& pendulum);

}  // namespace touchdown::policies
