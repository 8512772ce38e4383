#pragma once

#include "models/robot.hpp"

namespace touchdown::policies {

/// The seam for controllers: from what the robot observes to what its servos should do. A policy
/// never sees ground truth; contact, if it needs it, comes from an estimator fed by observations.
class Policy {
 public:
  virtual ~Policy() = default;

  /// Called once before the first step, with the observation at rest.
  virtual void reset(const models::Observation& observation) = 0;

  /// Called once per control step.
  virtual models::Action act(const models::Observation& observation) = 0;
};

}  // namespace touchdown::policies
