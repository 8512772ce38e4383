#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "estimator/phase/phase.hpp"
#include "estimator/signals.hpp"

namespace touchdown {

/// How the time around takeoffs and landings is divided into phases.
struct PhaseLabelConfig {
  /// A wheel's flight shorter than this (s) does not count as flight.
  double shortest_flight = 0.02;
  /// Times before a takeoff at which unloading 1, 2 and 3 begin (s), decreasing.
  std::array<double, 3> unloading = {0.150, 0.060, 0.020};
  /// Times after a landing at which impact 1, 2 and 3 end (s), increasing.
  std::array<double, 3> impact = {0.015, 0.060, 0.150};
  /// The robot is held, not falling, while its low-passed vertical acceleration differs from free
  /// fall by more than this (m/s²) …
  double held_margin = 3.0;
  /// … with this time constant of the low-pass (s).
  double held_low_pass = 0.05;
  /// A robot with both wheels in contact that does not fall is carried while the sum of their
  /// low-passed normal forces is below this (N); Upkie weighs 52 N …
  double carried_load = 40.0;
  /// … with this time constant of the low-pass (s).
  double carried_low_pass = 0.02;

  bool operator==(const PhaseLabelConfig&) const = default;
};

/// Throws InputError unless all times are finite, not negative and in the stated order.
void check_phase_labels(const PhaseLabelConfig& config);

/// Ground truth of one wheel's contact, one entry per step: 1 in contact, 0 not.
using WheelContact = std::span<const std::uint8_t>;

/// For a run in which something besides the ground may carry the robot: the steps at which it is
/// held (1) rather than falling (0), where |low-passed a_z + g| > held_margin. Meaningful only
/// where neither wheel is in contact.
std::vector<std::uint8_t> held_steps(std::span<const Signals> signals, double sample_rate,
                                     const PhaseLabelConfig& config);

/// The steps of such a run at which the robot is carried (1), from the normal force of both wheels
/// (N) and the result of `held_steps`. Meaningful only where both wheels are in contact. Throws
/// InputError for sequences of different lengths.
std::vector<std::uint8_t> carried_steps(const std::array<std::span<const double>, 2>& normal_force,
                                        std::span<const std::uint8_t> held, double sample_rate,
                                        const PhaseLabelConfig& config);

/// The phase of every step, from the ground truth of both wheels. Between a landing and a takeoff
/// that are close together, the nearer one decides; at the same distance, the takeoff. `held` and
/// `carried` may be empty if nothing ever holds or carries the robot. Throws InputError for
/// sequences of different lengths.
std::vector<Phase> label_phases(const std::array<WheelContact, 2>& contact,
                                std::span<const std::uint8_t> held, double sample_rate,
                                const PhaseLabelConfig& config,
                                std::span<const std::uint8_t> carried = {});

}  // namespace touchdown
