#pragma once

#include <cstddef>
#include <cstdint>

#include "estimator/decision/augmentation.hpp"
#include "estimator/force/leg_geometry.hpp"
#include "estimator/signal_guard.hpp"

namespace touchdown {

/// How a `DecisionModel` is fitted.
struct DecisionFitConfig {
  std::uint64_t seed = 1;      ///< of everything that is drawn
  std::size_t passes = 24;     ///< how often each run is heard, disturbed anew each time
  std::size_t rows = 400'000;  ///< about so many steps of wheels are learned from
  /// A share of the hearings hears one step in so many, as robots whose programs are slower do.
  std::size_t steps_of_slow = 5;
  double share_slow = 0.2;
  /// In a share of the hearings the low-passes begin anew from time to time, so that what is plain
  /// now counts at once, whatever was before: after so long on average (s), and so much longer for
  /// each N·m of noise, through which nothing is plain.
  double share_with_resets = 0.25;
  double reset_after = 0.1;
  double reset_after_noise = 0.4;
  std::size_t batch = 512;      ///< rows of one step of the descent
  std::size_t epochs = 14;      ///< how often each row is learned from, on average
  double learning_rate = 3e-3;  ///< of the first step; falls to nothing along a cosine
  double decay = 0.6;           ///< of the weights, relative to the learning rate
  /// A class weighs as the power of its count: 0 every step alike, −1 both classes alike.
  double class_exponent = -0.5;
  AugmentationConfig disturbance = {};  ///< what runs are heard through

  bool operator==(const DecisionFitConfig&) const = default;
};

/// Everything that can be chosen about the decision network, seen whole.
struct DecisionConfig {
  double sample_rate = 1000.0;  ///< at which `update` is called (Hz)
  LegGeometry geometry = {};
  /// Over this time differences of the wheel's and the axle's velocities are accelerations (s).
  double difference = 0.005;
  /// Time constant of the logit's low-pass for each N·m of estimated torque noise (s).
  double smoothing = 1.3e-3;
  /// A wheel leaves contact when P(contact) falls below this, and returns above that.
  double leave_below = 0.75;
  double return_above = 0.9;
  SignalGuardConfig guard = {};

  bool operator==(const DecisionConfig&) const = default;
};

/// Throw InputError for values that make no sense.
void check_decision_fit_config(const DecisionFitConfig& config);
void check_decision_config(const DecisionConfig& config);

}  // namespace touchdown
