#pragma once

#include "models/actuator.hpp"

namespace touchdown::simulators {

/// Coulomb friction of a joint, with elastic presliding (models/actuator.hpp).
class JointFriction {
 public:
  JointFriction() = default;  ///< without friction
  /// `inertia`: apparent inertia of the joint (kg·m²); `period`: physics step (s).
  JointFriction(const models::Actuator& actuator, double inertia, double period);

  /// Relaxes the presliding spring.
  void reset() { torque_ = 0.0; }
  /// The position at which the joint starts (rad).
  void start_at(double position) { position_ = position; }
  /// The torque that opposes the joint at `position` (rad) with `velocity` (rad/s), in N·m.
  double torque(double position, double velocity);

 private:
  double limit_ = 0.0;      ///< N·m
  double stiffness_ = 0.0;  ///< of presliding, limited by the time step (N·m/rad)
  double damping_ = 0.0;    ///< of presliding, critical (N·m·s/rad)
  double torque_ = 0.0;     ///< of the presliding spring (N·m)
  double position_ = 0.0;   ///< at the last step (rad)
};

}  // namespace touchdown::simulators
