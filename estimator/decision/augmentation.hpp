#pragma once

#include <array>

#include "estimator/decision/draws.hpp"
#include "estimator/signals.hpp"

namespace touchdown {

/// Random disturbances of the signals of a fit, so that the fitted model does not rely on ideal
/// sensors.
struct AugmentationConfig {
  /// White noise with levels log-uniform up to these (N·m, m/s²) …
  double largest_torque_noise = 4.0;
  double largest_acceleration_noise = 14.0;
  double share_without_noise = 0.25;  ///< of the draws, for each of the two
  /// … constant errors of each joint's torque (N·m) and of its zero (rad), normal, in a share of
  /// the draws …
  double torque_bias = 0.1;
  double position_bias = 0.01;
  double share_with_bias = 0.5;
  double gain_error = 0.1;  ///< … and an error of the scale of all torques, uniform within ± this.
  /// With the load by the servo law: share of the draws that have no targets.
  double share_without_targets = 0.25;

  bool operator==(const AugmentationConfig&) const = default;
};

/// Throws InputError for invalid values.
void check_augmentation_config(const AugmentationConfig& config);

/// The disturbances of one augmentation pass over a run.
class Augmentation {
 public:
  /// `with_targets`: whether targets are used. If not, their share draws nothing.
  Augmentation(const AugmentationConfig& config, Draws& draws, bool with_targets = false);

  /// Disturbs the signals of the next step.
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
  bool drops_targets_ = false;
  std::array<Bias, 6> bias_{};  ///< left hip, knee, wheel, then right
};

}  // namespace touchdown
