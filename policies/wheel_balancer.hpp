#pragma once

#include <array>

#include "estimator/upkie_observer.hpp"
#include "policies/crouching.hpp"
#include "policies/driving.hpp"
#include "policies/policy.hpp"

namespace touchdown::policies {

/// Keeps a wheeled biped upright on its wheels while it follows a velocity script, with its legs
/// stiff in the posture they had at the reset, or that a crouch script bends them to: Upkie's PI
/// law on pitch and position, plus feedback of the heading. It knows where it is by wheel odometry
/// and whether it is in the air by Upkie's own wheel contact observer.
class WheelBalancer : public Policy {
 public:
  /// `wheel_radius` in m; `period` of the control loop in s.
  WheelBalancer(const WheelBalancerConfig& config, VelocityScript script, double wheel_radius,
                double period, CrouchScript crouch = {});

  void reset(const models::Observation& observation) override;
  models::Action act(const models::Observation& observation) override;

  /// What the last action asked of the wheels (m/s).
  double ground_velocity_command() const { return ground_velocity_; }

 private:
  void follow_script(double time);
  void follow_crouch(double time);
  void update_odometry(const models::Observation& observation);
  bool in_the_air(const models::Observation& observation);
  void update_ground_velocity(const models::Observation& observation);
  double yaw_torque(const models::Observation& observation) const;
  double rolled_distance(const models::Observation& observation) const;

  WheelBalancerConfig config_;
  VelocityScript script_;
  double wheel_radius_;
  double period_;
  CrouchScript crouch_;
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
