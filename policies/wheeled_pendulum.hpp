#pragma once

#include "models/robot_model.hpp"
#include "policies/driving.hpp"

namespace touchdown::policies {

/// A wheeled biped with stiff legs, from the side: it leans by θ and its wheels' joints have turned
/// by ψ, so that the odometry is s = r·ψ. About standing upright, whatever the wheels' torque,
///
///     D·θ̈ + (C/r)·s̈ = G·θ
///
/// (the sum of both wheels' and the body's equations, in which their torques cancel).
/// docs/models.md derives it.
struct WheeledPendulum {
  double inertia = 0.0;        ///< D, of the whole robot about where its tyres touch (kg·m²)
  double coupling = 0.0;       ///< C, between leaning and rolling (kg·m²)
  double gravity = 0.0;        ///< G, the torque of gravity per radian of leaning (N·m/rad)
  double wheel_radius = 0.0;   ///< r (m)
  double wheel_inertia = 0.0;  ///< of one wheel about its axle, with its rotor (kg·m²)
  double track = 0.0;          ///< between the tyres (m)
};

/// The pendulum that a robot is in a pose in which it balances, heading along +x.
WheeledPendulum wheeled_pendulum(const models::RobotModel& robot,
                                 const Eigen::Quaterniond& orientation,
                                 const std::array<double, models::servo_count>& joint_position);

/// What the balancer's law is made of for this pendulum: its four gains on pitch and position by
/// LQR, and what else goes with a robot's size, all from its physics and in proportions that give
/// Upkie's default stance the gains found for it.
WheelBalancerConfig with_lqr_gains(WheelBalancerConfig config, const WheeledPendulum& pendulum);

}  // namespace touchdown::policies
