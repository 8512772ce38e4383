#pragma once

#include <memory>

#include "models/robot_model.hpp"
#include "policies/course.hpp"
#include "policies/wheel_contact.hpp"

namespace touchdown::policies {

/// The seam for controllers: maps observations to servo commands. A policy never receives ground
/// truth. If it needs contact, it gets it from an estimator that uses observations.
class Policy {
 public:
  virtual ~Policy() = default;

  /// Called once before the first step, with the observation at rest.
  virtual void reset(const models::Observation& observation) = 0;

  /// Called once per control step.
  virtual models::Action act(const models::Observation& observation) = 0;
};

/// What a control law is made of.
struct PolicyParts {
  WheelBalancerConfig gains;
  Course course;
  WheelContact contact = {};  ///< empty: Upkie's observer
  bool keep_lean = false;     ///< balance at the pitch of the reset, not at zero
};

/// Makes a control law for `robot`. Errors: `InputError` if the law needs hips that it has not.
std::unique_ptr<Policy> make_policy(PolicyConfig::Law law, PolicyParts parts,
                                    const models::RobotModel& robot);

// The laws, each in its own source.

std::unique_ptr<Policy> make_wheel_balancer(PolicyParts parts);
std::unique_ptr<Policy> make_soft_lander(PolicyParts parts, const models::RobotModel& robot);

}  // namespace touchdown::policies
