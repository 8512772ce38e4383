#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "estimator/phase/phase.hpp"
#include "estimator/signals.hpp"

namespace touchdown {

/// How the time around takeoffs and landings is cut into phases.
struct PhaseLabelConfig {
  /// A wheel's flight that is shorter than this is no flight (s).
  double shortest_flight = 0.02;
  /// How long before a takeoff unloading 1, 2 and 3 begin (s), decreasing.
  std::array<double, 3> unloading = {0.150, 0.060, 0.020};
  /// How long after a landing impact 1, 2 and 3 end (s), increasing.
  std::array<double, 3> impact = {0.015, 0.060, 0.150};
  /// The robot is held, not falling, while its low-passed vertical acceleration is further than
  /// this from free fall (m/s²) …
  double held_margin = 3.0;
  /// … with this time constant of the low-pass (s).
  double held_low_pass = 0.05;
  /// A robot that does not fall is carried, though its wheels touch, while they push with less than
  /// this together (N, low-passed): less than most of Upkie's weight of 52 N …
  double carried_load = 40.0;
  /// … with this time constant of the low-pass (s).
  double carried_low_pass = 0.02;

  bool operator==(const PhaseLabelConfig&) const = default;
};

/// Throws InputError unless all times are finite, not negative and in the order that is asked for.
void check_phase_labels(const PhaseLabelConfig& config);

/// Truth of one wheel's contact, one entry per step: 1 touches, 0 does not.
using WheelContact = std::span<const std::uint8_t>;

/// For a run in which something besides the ground may carry the robot: at which steps it is held
/// (1) rather than falling (0), judged by |low-passed a_z + g| > held_margin. Meaningful only where
/// neither wheel touches.
std::vector<std::uint8_t> held_steps(std::span<const Signals> signals, double sample_rate,
                                     const PhaseLabelConfig& config);

/// At which steps of such a run the robot is carried (1), from the normal force of both wheels (N)
/// and what `held_steps` says. Meaningful only where both wheels touch. Throws InputError for
/// sequences of different lengths.
std::vector<std::uint8_t> carried_steps(const std::array<std::span<const double>, 2>& normal_force,
                                        std::span<const std::uint8_t> held, double sample_rate,
                                        const PhaseLabelConfig& config);

/// The phase of every step from the truth about both wheels. Between a landing and a takeoff that
/// are close together, the nearer one decides (the takeoff, at the same distance). `held` and
/// `carried` may be empty: nothing ever holds the robot, nothing ever carries it. Throws InputError
/// for sequences of different lengths.
std::vector<Phase> label_phases(const std::array<WheelContact, 2>& contact,
                                std::span<const std::uint8_t> held, double sample_rate,
                                const PhaseLabelConfig& config,
                                std::span<const std::uint8_t> carried = {});

}  // namespace touchdown
