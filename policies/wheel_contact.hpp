#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "models/robot.hpp"

namespace touchdown {
class Fields;
}

namespace touchdown::policies {

/// A contact source: returns which wheels are in contact, once per control step. Its second input
/// is the policy's action of the step before, null at the first step.
using WheelContact = std::function<std::array<bool, models::wheel_count>(
    const models::Observation& observation, const models::Action* previous)>;

/// Upkie's own observer, one per wheel. `period` of the control loop in s.
WheelContact upkie_contact(double period);

/// From `time` on, the policy receives this contact.
struct ContactCommand {
  double time = 0.0;  ///< s
  bool left = true;
  bool right = true;

  bool operator==(const ContactCommand&) const = default;
};

/// Contact that was recorded in another run, sorted by time. Before the first one both wheels are
/// in contact.
using ContactScript = std::vector<ContactCommand>;

/// Repeats recorded contact.
WheelContact scripted_contact(ContactScript script);

/// The control law of the robot and its contact source.
struct PolicyConfig {
  enum class Law : int {
    balancer,     ///< policies/wheel_balancer.cpp
    soft_landing  ///< policies/soft_lander.cpp
  };
  Law law = Law::balancer;
  /// An estimator that needs no fit, `always`, `script`, or the oracle `truth`, which no robot has.
  std::string contact = "upkie_observer";
  double delay = 0.0;                 ///< of the contact signal (s)
  ContactScript contact_script = {};  ///< for the contact source `script`

  bool operator==(const PolicyConfig&) const = default;
};

/// Describes one command of `script`. When reading, it is the last so far, and must be the latest.
void describe(Fields& fields, ContactCommand& command, const ContactScript& script);
void describe(Fields& fields, PolicyConfig& policy);

}  // namespace touchdown::policies
