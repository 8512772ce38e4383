#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace touchdown {

/// The phases of both legs between rolling and falling: the joint states of the phase filter's
/// hidden Markov model (docs/explanation/phase_filter.md).
enum class Phase : std::uint8_t {
  rolling,      ///< both wheels carry the robot; no takeoff or landing is near
  unloading_1,  ///< both wheels are in contact; they take off in 150 to 60 ms
  unloading_2,  ///< … in 60 to 20 ms
  unloading_3,  ///< … within 20 ms
  flight,       ///< neither wheel is in contact, and nothing else holds the robot
  impact_1,     ///< both wheels are in contact; they landed up to 15 ms ago
  impact_2,     ///< … 15 to 60 ms ago
  impact_3,     ///< … 60 to 150 ms ago
  held,         ///< neither wheel is in contact, but the robot does not fall: hung or lifted
  carried,      ///< both wheels are in contact, but something else carries most of the robot
  left_only,    ///< only the left wheel is in contact
  right_only,   ///< only the right wheel is in contact
};

inline constexpr std::size_t phase_count = 12;

/// Torque densities: one for each phase in which both legs are alike, and two for the single-wheel
/// phases: that of the leg that carries the robot, and that of the leg in the air.
inline constexpr std::size_t torque_density_count = 12;
inline constexpr std::size_t supporting_leg = 10;
inline constexpr std::size_t airborne_leg = 11;

/// Acceleration densities: one per phase, except that the two single-wheel phases share the last.
inline constexpr std::size_t acceleration_density_count = 11;

constexpr std::size_t index(Phase phase) noexcept { return static_cast<std::size_t>(phase); }

/// Names in the order of `Phase`.
inline constexpr std::array<std::string_view, phase_count> phase_names = {
    "rolling",  "unloading_1", "unloading_2", "unloading_3", "flight",    "impact_1",
    "impact_2", "impact_3",    "held",        "carried",     "left_only", "right_only"};

constexpr bool left_in_contact(Phase phase) noexcept {
  return phase != Phase::flight && phase != Phase::held && phase != Phase::right_only;
}

constexpr bool right_in_contact(Phase phase) noexcept {
  return phase != Phase::flight && phase != Phase::held && phase != Phase::left_only;
}

/// The phase with left and right exchanged.
constexpr Phase mirrored(Phase phase) noexcept {
  if (phase == Phase::left_only) return Phase::right_only;
  if (phase == Phase::right_only) return Phase::left_only;
  return phase;
}

/// A probability per phase.
using PhaseProbabilities = std::array<double, phase_count>;

}  // namespace touchdown
