#pragma once

#include <array>

#include "estimator/contact_estimator.hpp"

namespace touchdown {

/// Thresholds of Upkie's own wheel-contact observer, with the values of Upkie's configuration.
struct WheelContactConfig {
  /// In contact, an apparent inertia below this means liftoff (kg·m²).
  double liftoff_inertia = 0.001;
  /// In the air, an apparent inertia above this means touchdown (kg·m²) …
  double touchdown_inertia = 0.004;
  /// … if the wheel accelerates at least this much (rad/s²) …
  double minimum_touchdown_acceleration = 2.0;
  /// … under at least this much torque (N·m).
  double minimum_touchdown_torque = 0.015;
  /// Time constant of the low-pass of |torque| and |acceleration| (s).
  double cutoff = 0.2;
  /// The state until torque and motion of the wheel decide. They decide at once for a wheel that
  /// hangs in the air, and never for a wheel at rest on the ground.
  bool initially_in_contact = true;

  bool operator==(const WheelContactConfig&) const = default;
};

/// The contact observer that Upkie's users run today. A wheel on the ground has to move the robot,
/// a wheel in the air only itself. The ratio of low-passed |torque| to |angular acceleration| is an
/// apparent inertia that distinguishes the two, by two thresholds with hysteresis. It is simple
/// enough for a policy. It never throws or allocates, and skips inputs that are not finite.
class WheelContactObserver {
 public:
  explicit WheelContactObserver(const WheelContactConfig& config = {}) noexcept;

  void reset() noexcept;

  /// One step: wheel torque (N·m), wheel velocity (rad/s), time since the previous step (s).
  /// Returns whether the wheel is in contact.
  bool update(double torque, double velocity, double time_step) noexcept;

  [[nodiscard]] bool contact() const noexcept { return contact_; }
  /// Low-passed |torque| / |acceleration| (kg·m²); 0 until the wheel has accelerated.
  [[nodiscard]] double inertia() const noexcept { return inertia_; }

 private:
  WheelContactConfig config_;
  bool contact_;
  bool started_ = false;
  double velocity_ = 0.0;
  double abs_torque_ = 0.0;
  double abs_acceleration_ = 0.0;
  double inertia_ = 0.0;
};

struct UpkieObserverConfig {
  WheelContactConfig wheel = {};
  /// Nominal time between updates (s).
  double time_step = 0.001;
  /// Time constant of the low-pass of the upper legs' torque (s).
  double upper_leg_cutoff = 0.01;
  /// The robot is on the floor if the norm of its hip and knee torques exceeds this (N·m).
  double upper_leg_torque_threshold = 10.0;

  bool operator==(const UpkieObserverConfig&) const = default;
};

/// Upkie's floor-contact observer as a contact estimator: its probabilities are 0 or 1. The robot
/// is on the floor (p_any_wheel) if either wheel is in contact or if the legs carry a load. Inputs
/// that are not finite leave the last decision in place, and the status reports them.
class UpkieObserver : public ContactEstimator {
 public:
  explicit UpkieObserver(const UpkieObserverConfig& config = {}) noexcept;

  void reset() noexcept override;

  [[nodiscard]] const Belief& belief() const noexcept { return belief_; }
  [[nodiscard]] const WheelContactObserver& wheel(Side side) const noexcept {
    return wheel_[static_cast<std::size_t>(side)];
  }
  /// Low-passed norm of the hip and knee torques of both legs (N·m).
  [[nodiscard]] double upper_leg_torque() const noexcept { return upper_leg_torque_; }

 private:
  const Belief& estimate(const Signals& signals) noexcept override;

  void apply_threshold() noexcept;

  UpkieObserverConfig config_;
  std::array<WheelContactObserver, 2> wheel_;
  double upper_leg_torque_ = 0.0;
  Belief belief_;
};

}  // namespace touchdown
