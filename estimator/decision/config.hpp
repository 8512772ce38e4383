#pragma once

#include <cstddef>
#include <cstdint>

#include "estimator/decision/augmentation.hpp"
#include "estimator/decision/operating_point.hpp"
#include "estimator/force/leg_geometry.hpp"
#include "estimator/signal_guard.hpp"

namespace touchdown {

/// How a `DecisionModel` is fitted.
struct DecisionFitConfig {
  std::uint64_t seed = 1;      ///< of all random draws
  std::size_t passes = 24;     ///< augmentation passes over each run, each disturbed anew
  std::size_t rows = 400'000;  ///< approximate number of fitted steps, counted per wheel
  /// A share of the passes uses only one step in so many, like robots with slower programs.
  std::size_t steps_of_slow = 5;
  double share_slow = 0.2;
  /// In a share of the passes the state of the low-passes resets at random times, so that clear
  /// present signals count at once, whatever came before. The mean time between resets is
  /// `reset_after` (s) plus `reset_after_noise` (s per N·m) times the torque noise, because no
  /// present signal is clear in strong noise.
  double share_with_resets = 0.25;
  double reset_after = 0.1;
  double reset_after_noise = 0.4;
  std::size_t batch = 512;      ///< rows per step of the descent
  std::size_t epochs = 14;      ///< mean number of uses of each row
  double learning_rate = 3e-3;  ///< of the first step; falls to zero along a cosine
  double decay = 0.6;           ///< of the weights, relative to the learning rate
  /// A class weighs as this power of its count: 0 weighs all steps equally, −1 both classes
  /// equally.
  double class_exponent = -0.5;
  AugmentationConfig augmentation = {};  ///< disturbances of the fitted signals

  bool operator==(const DecisionFitConfig&) const = default;
};

/// Of evidence curves: both errors count alike.
inline constexpr OperatingPoint balanced_point = {
    .leave_below = 0.85, .return_above = 0.99, .settle_at = 0.9, .settle_after = 0.02};
/// Of evidence curves: few false takeoffs, at the price of later ones.
inline constexpr OperatingPoint quiet_point = {.leave_below = 0.4, .return_above = 0.99};
/// Of the decision network: both errors count alike.
inline constexpr OperatingPoint network_point = {.leave_below = 0.75, .return_above = 0.9};

/// All settings of the decision network and of evidence curves.
struct DecisionConfig {
  double sample_rate = 1000.0;  ///< at which `update` is called (Hz)
  LegGeometry geometry = {};
  /// Accelerations of the wheel and the axle are differences of their velocities over this time
  /// (s).
  double difference = 0.005;
  /// Whether the load by the servo law is one more channel (`ServoLoadInputs`). Fits decide; an
  /// estimator follows its model.
  bool servo_load = false;
  /// Time constant of the logit's low-pass per N·m of estimated torque noise (s).
  double smoothing = 1e-3;
  OperatingPoint point = balanced_point;
  SignalGuardConfig guard = {};

  bool operator==(const DecisionConfig&) const = default;
};

/// Throw InputError for invalid values.
void check_decision_fit_config(const DecisionFitConfig& config);
void check_decision_config(const DecisionConfig& config);

}  // namespace touchdown
