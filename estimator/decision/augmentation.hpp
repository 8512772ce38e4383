#pragma once

#include <array>

#include "estimator/decision/draws.hpp"
#include "estimator/signals.hpp"

namespace touchdown {

/// What those that are fitted to decide are fitted through, so that they need not rely on what no
/// robot's sensors are.
struct AugmentationConfig {
  /// White noise of levels log-uniform up to these (N·m, m/s²) …
  double largest_torque_noise = 4.0;
  double largest_acceleration_noise = 14.0;
  double share_without_noise = 0.25;  ///< of each of the two
  /// … constant errors of each joint's torque (N·m) and of its zero (rad), normal, in a share of
  /// the draws …
  double torque_bias = 0.1;
  double position_bias = 0.01;
  double share_with_bias = 0.5;
  double gain_error = 0.1;  ///< … and an error of all torques' scale, uniform on both sides.

  bool operator==(const AugmentationConfig&) const = default;
};

/// Throws InputError for values that make no sense.
void check_augmentation_config(const AugmentationConfig& config);

/// What one hearing of a run is disturbed with.
class Augmentation {
 public:
  Augmentation(const AugmentationConfig& config, Draws& draws);

  /// The next step as it is heard.
  Signals operator()(Signals signals);

  [[nodiscard]] double torque_noise() const noexcept { return torque_noise_; }  ///< N·m

 private:
  struct Bias {
    double torque = 0.0;    ///< N·m
    double position = 0.0;  ///< rad
  };

  double level(const AugmentationConfig& config, double largest);

  Draws& draws_;
  double torque_noise_ = 0.0;
  double acceleration_noise_ = 0.0;
  double scale_ = 1.0;
  std::array<Bias, 6> bias_{};  ///< left hip, knee, wheel, right ones
};

}  // namespace touchdown
