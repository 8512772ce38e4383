#pragma once

#include <optional>
#include <vector>

#include "estimator/phase/labels.hpp"
#include "estimator/signal_guard.hpp"

namespace touchdown {

/// How the densities and transitions of a `PhaseModel` are fitted.
struct PhaseFitConfig {
  /// How the fitted runs are cut into phases.
  PhaseLabelConfig labels;
  /// Kernel width of the torque densities before sensor noise (N·m).
  double torque_bandwidth = 0.15;
  /// Kernel width of the acceleration densities before sensor noise (m/s²).
  double acceleration_bandwidth = 1.0;
  /// Sensor noise for which densities are prepared, increasing (N·m and m/s²). Torque densities are
  /// prepared for each of them at the knee with each at the wheel. Between them the filter
  /// interpolates.
  std::vector<double> torque_noise = {0.0, 0.2, 0.4, 0.8, 1.6, 3.2, 6.4};
  std::vector<double> acceleration_noise = {0.0, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0};
  /// Distance of the grids' points in total bandwidths.
  double grid_step = 1.0 / 3.0;
  /// Largest distance of the grids' points (N·m).
  double largest_knee_step = 0.5;
  double largest_wheel_step = 0.5;
  /// Share of a uniform density that is mixed into each density: what was never seen is not
  /// impossible.
  double contamination = 1e-3;
  /// Half widths of the uniform densities, to which four bandwidths are added (N·m, m/s²).
  double knee_range = 17.0;
  double wheel_range = 1.8;
  double acceleration_range = 300.0;
  /// With less labelled time on a single wheel than this (s) its legs borrow densities: that of
  /// rolling, and that of flight.
  double least_single_wheel = 0.5;
  /// Added to every transition count.
  double pseudo_count = 0.01;
  /// A density is made of at most so many samples, evenly thinned out (0: no limit).
  std::size_t largest_sample = 20'000;

  bool operator==(const PhaseFitConfig&) const = default;
};

/// Standard deviations of white sensor noise.
struct PhaseNoise {
  double knee_torque = 0.0;   ///< N·m
  double wheel_torque = 0.0;  ///< N·m
  double acceleration = 0.0;  ///< m/s²

  bool operator==(const PhaseNoise&) const = default;
};

/// Everything that can be chosen about the phase filter, seen whole.
struct PhaseFilterConfig {
  /// Rate at which `update` is called (Hz): the model's rate divided by a whole number.
  double sample_rate = 1000.0;
  /// How its model is fitted.
  PhaseFitConfig fit;
  /// Exponent of the likelihoods of torques and of acceleration: consecutive samples are not
  /// independent, so each counts for less than one.
  double torque_exponent = 0.5;
  double acceleration_exponent = 0.5;
  /// A wheel leaves contact when P(contact) falls below this, and returns above that.
  double leave_below = 0.25;
  double return_above = 0.75;
  /// The sensor noise, if it is known; otherwise it is estimated while running.
  std::optional<PhaseNoise> noise;
  /// The estimated noise is never taken for smaller than this.
  PhaseNoise noise_floor = {0.02, 0.02, 0.1};
  /// Relative change of the estimated noise at each step.
  double noise_gain = 0.01;
  /// Until it has run for this long (s), the estimate moves faster, as 1/time.
  double noise_warm_up = 0.1;
  /// What to do with signals that cannot be used.
  SignalGuardConfig guard;

  bool operator==(const PhaseFilterConfig&) const = default;
};

/// Throws InputError for values that make no sense.
void check_phase_fit_config(const PhaseFitConfig& config);
void check_phase_filter_config(const PhaseFilterConfig& config);

}  // namespace touchdown
