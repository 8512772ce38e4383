#pragma once

#include "policies/course.hpp"
#include "policies/policy.hpp"
#include "policies/wheel_contact.hpp"

namespace touchdown::policies {

/// Keeps a wheeled biped upright on its wheels while it follows a velocity script, with its legs
/// stiff in the posture they had at the reset, or that a crouch script bends them to: Upkie's PI
/// law on pitch and position, plus feedback of the heading. It knows where it is by wheel odometry
/// and whether it is in the air by Upkie's own wheel contact observer, unless told by another.
class WheelBalancer : public Policy {
 public:
  /// `wheel_radius` in m; `period` of the control loop in s.
  WheelBalancer(const WheelBalancerConfig& config, VelocityScript script, double wheel_radius,
                double period, CrouchScript crouch = {}, WheelContact contact = {});

  void reset(const models::Observation& observation) override;
  models::Action act(const models::Observation& observation) override;

  /// What the last action asked of the wheels (m/s).
  double ground_velocity_command() const { return ground_velocity_; }

 private:
  bool in_the_air(const models::Observation& observation);
  void update_ground_velocity(const models::Observation& observation);

  WheelBalancerConfig config_;
  Course course_;
  WheelContact told_;  ///< by somebody else than Upkie's observer
  WheelContact contact_;

  double integral_ = 0.0;
  double ground_velocity_ = 0.0;
};

}  // namespace touchdown::policies
