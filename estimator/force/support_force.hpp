#pragma once

#include "estimator/contact_estimator.hpp"
#include "estimator/force/wheel_loads.hpp"

namespace touchdown {

struct SupportForceConfig {
  double sample_rate = 1000.0;  ///< at which `update` is called (Hz)
  LegGeometry geometry = {};
  double low_pass = 0.01;  ///< time constant of the low-pass of the force (s)
  double contact = 12.0;   ///< in contact from this force on (N) …
  double release = 6.0;    ///< … until it falls below this
  /// P(contact) = 1 / (1 + exp(−(force − middle) / width)), with the middle between the two (N).
  double width = 1.5;
  SignalGuardConfig guard = {};
};

/// The usual method for wheeled legs: the normal force on each wheel from the torques of its leg
/// through the leg's Jacobian, low-passed, with hysteresis. It needs the leg's geometry and no fit.
/// It detects single wheels as well as both, and lifts as well as falls. It is weak where the leg
/// is straight, and as noisy as the torques.
///
/// `update` never throws, allocates or locks, and never returns NaN. While the acceleration or a
/// leg's torques are not usable, the belief relaxes to the prior and the status gives the reason.
class SupportForce : public ContactEstimator {
 public:
  /// Throws InputError for a rate, width or length that is not positive, a negative time constant,
  /// and thresholds out of order.
  explicit SupportForce(const SupportForceConfig& config = {});

  void reset() noexcept override;

  /// The low-passed force on one wheel (N).
  [[nodiscard]] double force(Side side) const noexcept {
    return loads_.force(static_cast<std::size_t>(side));
  }

 private:
  const Belief& estimate(const Signals& signals) noexcept override;

  SupportForceConfig config_;
  WheelLoads loads_;
  Belief belief_;
};

}  // namespace touchdown
