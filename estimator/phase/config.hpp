#pragma once

#include <optional>
#include <vector>

#include "estimator/phase/labels.hpp"
#include "estimator/signal_guard.hpp"

namespace touchdown {

/// How the densities and transitions of a `PhaseModel` are fitted.
struct PhaseFitConfig {
  /// How the fitted runs are divided into phases.
  PhaseLabelConfig labels;
  /// Kernel width of the torque densities before sensor noise (N·m).
  double torque_bandwidth = 0.15;
  /// Kernel width of the acceleration densities before sensor noise (m/s²).
  double acceleration_bandwidth = 1.0;
  /// Increasing levels of sensor noise with a density each (N·m and m/s²). Torque densities exist
  /// for each level at the knee with each level at the wheel. The filter interpolates between
  /// levels.
  std::vector<double> torque_noise = {0.0, 0.2, 0.4, 0.8, 1.6, 3.2, 6.4};
  std::vector<double> acceleration_noise = {0.0, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0};
  /// Distance of the grids' points in total bandwidths.
  double grid_step = 1.0 / 3.0;
  /// Largest distance of the grids' points (N·m).
  double largest_knee_step = 0.5;
  double largest_wheel_step = 0.5;
  /// Share of a uniform density in each density, so that signals that the fitted runs lack are not
  /// impossible.
  double contamination = 1e-3;
  /// Half widths of the uniform densities before four bandwidths are added (N·m, m/s²).
  double knee_range = 17.0;
  double wheel_range = 1.8;
  double acceleration_range = 300.0;
  /// If less labelled time on a single wheel exists than this (s), its legs use the densities of
  /// rolling and of flight.
  double least_single_wheel = 0.5;
  /// Added to every transition count.
  double pseudo_count = 0.01;
  /// A density uses at most this many samples, evenly thinned out (0: no limit).
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

/// All settings of the phase filter.
struct PhaseFilterConfig {
  /// Rate at which `update` is called (Hz): the model's rate divided by a whole number.
  double sample_rate = 1000.0;
  /// How its model is fitted.
  PhaseFitConfig fit;
  /// Exponents of the likelihoods of torques and of acceleration. Consecutive samples are not
  /// independent, so each counts less than one.
  double torque_exponent = 0.5;
  double acceleration_exponent = 0.5;
  /// A wheel leaves contact when P(contact) falls below this, and returns above that.
  double leave_below = 0.25;
  double return_above = 0.75;
  /// The sensor noise, if known; otherwise the filter estimates it while running.
  std::optional<PhaseNoise> noise;
  /// Lower bound of the estimated noise.
  PhaseNoise noise_floor = {0.02, 0.02, 0.1};
  /// Relative change of the estimated noise at each step.
  double noise_gain = 0.01;
  /// During this time after the start (s) the estimate moves faster, as 1/time.
  double noise_warm_up = 0.1;
  /// Treatment of unusable signals.
  SignalGuardConfig guard;

  bool operator==(const PhaseFilterConfig&) const = default;
};

/// Throw InputError for invalid values.
void check_phase_fit_config(const PhaseFitConfig& config);
void check_phase_filter_config(const PhaseFilterConfig& config);

}  // namespace touchdown
