#pragma once

#include <algorithm>
#include <cmath>

#include "models/actuator.hpp"

namespace touchdown::models {

// What both engines simulate at a joint beside its servo's law. Gains are limited so that each is
// stable on its own at the physics step `period` (s), with the joint's apparent `inertia` (kg·m²).

/// A spring's stiffness (N·m/rad).
inline double stable_stiffness(double wanted, double inertia, double period) {
  return std::min(wanted, 0.25 * inertia / (period * period));
}

/// A damper's (N·m·s/rad).
inline double stable_damping(double wanted, double inertia, double period) {
  return std::min(wanted, 0.5 * inertia / period);
}

/// The share of these limits that servos of held joints have, because joints move each other.
inline constexpr double held_share = 0.5;

/// Dry friction before it slides: a critically damped spring.
struct Presliding {
  double stiffness = 0.0;  ///< N·m/rad
  double damping = 0.0;    ///< N·m·s/rad
};

inline Presliding presliding(const Actuator& actuator, double inertia, double period) {
  if (actuator.friction == 0.0 && actuator.load_friction == 0.0) return {};
  const double stiffness = stable_stiffness(actuator.presliding_stiffness, inertia, period);
  return {stiffness, 2.0 * std::sqrt(stiffness * inertia)};
}

/// Weight of the newest acceleration in what Bullet's rotors compensate (bullet_simulator.cpp).
/// With 1, stiff standing robots oscillate; 0.5 suffices.
inline constexpr double rotor_smoothing = 0.25;

}  // namespace touchdown::models
