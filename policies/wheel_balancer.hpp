#pragma once

#include "estimator/upkie_observer.hpp"
#include "policies/policy.hpp"
#include "policies/velocity_script.hpp"

namespace touchdown {
class Fields;
}

namespace touchdown::policies {

/// Gains of the balancer. Errors are target − measurement.
struct WheelBalancerConfig {
  double pitch_stiffness = 32.0;    ///< integral on the pitch error (m/s² per rad)
  double pitch_damping = 5.5;       ///< proportional on the pitch error (m/s per rad)
  double position_stiffness = 1.5;  ///< integral on the position error (1/s²)
  double position_damping = 3.0;    ///< proportional on the position error (1/s)
  double max_velocity = 2.0;        ///< of the commanded ground velocity (m/s)
  double max_integral = 10.0;       ///< of the accumulated part of that command (m/s)
  double max_acceleration = 1.0;    ///< of the target velocity (m/s²)
  double max_position_error = 1.0;  ///< m
  double air_decay_time = 1.0;      ///< of the integral while both wheels are in the air (s)
  double wheel_kd_scale = 0.2;      ///< of the wheels' velocity servo
  double yaw_stiffness = 1.0;       ///< differential wheel torque (N·m/rad)
  double yaw_damping = 0.1;         ///< N·m·s/rad
  double lateral_stiffness = 0.5;   ///< heading asked for per metre beside the course (rad/m)
  double max_lateral_error = 0.6;   ///< m
  bool keep_heading = false;        ///< the course is the heading at the reset, not the world's +x
  double leg_kp_scale = 2.0;        ///< of the hips and knees
  double leg_kd_scale = 2.0;        ///< of the hips and knees
};

void describe(Fields& fields, WheelBalancerConfig& config);

/// Keeps a wheeled biped upright on its wheels while it follows a velocity script, with its legs
/// stiff in the posture they had at the reset: Upkie's PI law on pitch and position, plus feedback
/// of the heading. It knows where it is by wheel odometry and whether it is in the air by Upkie's
/// own wheel contact observer.
class WheelBalancer : public Policy {
 public:
  /// `wheel_radius` in m; `period` of the control loop in s.
  WheelBalancer(const WheelBalancerConfig& config, VelocityScript script, double wheel_radius,
                double period);

  void reset(const models::Observation& observation) override;
  models::Action act(const models::Observation& observation) override;

  /// What the last action asked of the wheels (m/s).
  double ground_velocity_command() const { return ground_velocity_; }

 private:
  void follow_script(double time);
  void update_odometry(const models::Observation& observation);
  bool in_the_air(const models::Observation& observation);
  void update_ground_velocity(const models::Observation& observation);
  double yaw_torque(const models::Observation& observation) const;
  double rolled_distance(const models::Observation& observation) const;

  WheelBalancerConfig config_;
  VelocityScript script_;
  double wheel_radius_;
  double period_;
  std::array<WheelContactObserver, models::wheel_count> contact_;

  std::array<double, models::servo_count> posture_ = {};
  double target_velocity_ = 0.0;
  double target_position_ = 0.0;
  double target_yaw_ = 0.0;
  double position_ = 0.0;  ///< along the ground, by odometry (m)
  double lateral_ = 0.0;   ///< to the left of the target heading, by odometry (m)
  double last_distance_ = 0.0;
  double last_yaw_ = 0.0;
  double heading_ = 0.0;  ///< yaw without its jumps by 2π (rad)
  double integral_ = 0.0;
  double ground_velocity_ = 0.0;
};

}  // namespace touchdown::policies
