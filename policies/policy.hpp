#pragma once

#include "models/robot.hpp"

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

}  // namespace touchdown::policies
