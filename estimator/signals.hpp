#pragma once

#include <array>
#include <limits>

#include <Eigen/Core>

namespace touchdown {

/// Index of a leg in every per-wheel array.
enum class Side : int { left = 0, right = 1 };

/// What one joint's servo reports, in the joint's own sign convention (rad, rad/s, N·m).
struct JointSignals {
  double position = 0.0;
  double velocity = 0.0;
  double torque = 0.0;
};

struct LegSignals {
  JointSignals hip;
  JointSignals knee;
  JointSignals wheel;
};

/// The command that a joint's servo executed when its signals were measured, in the joint's own
/// sign convention. The servo's law is τ* = k_p (q* − q) + k_d (q̇* − q̇) + τ_ff. NaN: not known.
struct JointTarget {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  double position = unknown;            ///< q* (rad)
  double velocity = unknown;            ///< q̇* (rad/s)
  double feedforward_torque = unknown;  ///< τ_ff (N·m)
  double kp = unknown;                  ///< k_p (N·m/rad)
  double kd = unknown;                  ///< k_d (N·m·s/rad)
};

struct LegTargets {
  JointTarget hip;
  JointTarget knee;
  JointTarget wheel;
};

/// All signals that a contact estimator may use at one time step. They contain no ground truth:
/// the robot measures or commands each of them.
struct Signals {
  /// Time of the measurement (s). Estimators use only differences.
  double time = 0.0;
  /// Left leg, right leg.
  std::array<LegSignals, 2> leg;
  /// Acceleration of the IMU without gravity, in the IMU frame (m/s²).
  Eigen::Vector3d linear_acceleration = Eigen::Vector3d::Zero();
  /// Angular velocity of the IMU in its own frame (rad/s).
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();
  /// `linear_acceleration` projected on the world's upward vertical, γ^z in the paper (m/s²).
  double vertical_acceleration = 0.0;
  /// Ground velocity that the policy commanded at the previous step (m/s).
  double ground_velocity_command = 0.0;
  /// Left leg, right leg. Optional: no other signal depends on them.
  std::array<LegTargets, 2> target = {};
  /// The world's upward vertical in the IMU frame, by its orientation; NaN: not known. The default
  /// is that of a level torso.
  Eigen::Vector3d up = {0.0, 0.0, -1.0};
};

}  // namespace touchdown
