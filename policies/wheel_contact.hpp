#pragma once

#include <array>
#include <functional>
#include <string>

#include "models/robot.hpp"

namespace touchdown {
class Fields;
}

namespace touchdown::policies {

/// Which wheels touch, as a policy is told once per control step; also given: the ground velocity
/// that it asked for one step before (m/s).
using WheelContact = std::function<std::array<bool, models::wheel_count>(
    const models::Observation& observation, double ground_velocity_command)>;

/// Upkie's own observer, a wheel each.
WheelContact upkie_contact(double period);

/// Which law drives the robot, and who tells it about contact.
struct PolicyConfig {
  enum class Law : int {
    balancer,     ///< policies/wheel_balancer.hpp
    soft_landing  ///< policies/soft_lander.hpp
  };
  Law law = Law::balancer;
  /// An estimator that needs no fit; `always`; or `truth`: an oracle, which no robot has.
  std::string contact = "upkie_observer";
  double delay = 0.0;  ///< what is told reaches the law so much later (s)

  bool operator==(const PolicyConfig&) const = default;
};

void describe(Fields& fields, PolicyConfig& policy);

}  // namespace touchdown::policies
