#pragma once

#include <optional>

#include "policies/course.hpp"
#include "policies/policy.hpp"
#include "policies/wheel_contact.hpp"

namespace touchdown::policies {

/// Balances a wheeled biped while it follows a velocity script. It is Upkie's PI law on pitch and
/// position, plus feedback of the heading. The legs are stiff, in the posture of the reset or of a
/// crouch script. The position comes from wheel odometry. Contact comes from Upkie's wheel contact
/// observer, unless another contact source is given.
class WheelBalancer : public Policy {
 public:
  /// `keep_lean`: balance at the pitch of the reset, not at zero.
  WheelBalancer(const WheelBalancerConfig& config, Course course, WheelContact contact = {},
                bool keep_lean = false);

  void reset(const models::Observation& observation) override;
  models::Action act(const models::Observation& observation) override;

  /// The wheel velocity that the last action commanded (m/s).
  double ground_velocity_command() const { return ground_velocity_; }

 private:
  bool in_the_air(const models::Observation& observation);
  void update_ground_velocity(const models::Observation& observation);

  WheelBalancerConfig config_;
  Course course_;
  WheelContact given_contact_source_;  ///< empty: Upkie's observer
  WheelContact contact_source_;

  bool keep_lean_;
  double lean_ = 0.0;  ///< pitch at which the robot balances (rad)
  double integral_ = 0.0;
  double ground_velocity_ = 0.0;
  std::optional<models::Action> previous_;  ///< the last action
};

}  // namespace touchdown::policies
