#pragma once

#include "estimator/contact_estimator.hpp"
#include "estimator/force/logistic_regression.hpp"
#include "estimator/force/wheel_loads.hpp"

namespace touchdown {

struct LoadLogisticConfig {
  double sample_rate = 1000.0;  ///< at which `update` is called (Hz)
  LegGeometry geometry = {};
  double low_pass = 0.01;        ///< time constant of the low-pass of the force (s)
  double largest_force = 200.0;  ///< the force is limited to this (N): four times Upkie's weight
  double threshold = 0.5;        ///< in contact from this probability on
  SignalGuardConfig guard = {};
};

/// Published for legged robots: Camurri, Fallon, Bazeille, Radulescu, Barasuol, Caldwell, Semini,
/// "Probabilistic Contact Estimation and Impact Detection for State Estimation of Quadruped Robots"
/// (RA-L 2017). The ground reaction force F_z of each foot follows from the torques of its leg, and
///
///     P(contact) = 1 / (1 + exp(−(β₁ F_z + β₀))),
///
/// with β fitted by logistic regression. The foot is in contact where P is above one half. Written
/// from memory of the paper. Adapted as follows:
///
/// - a wheel is the foot, its axle the end of the leg; the wheel's own torque acts along the ground
///   and does not count;
/// - the paper computes forces from the whole body's dynamics; here they follow from each leg's
///   weight and the vertical acceleration (`vertical_force`), on a level torso;
/// - the paper fits each leg and gait; here both wheels share one curve, fitted to labelled runs;
/// - the force is low-passed, as in `SupportForce`, and limited, because nearly straight legs give
///   forces without bounds;
/// - the paper's detection of impacts, which scales the covariance of a state estimator, is left
/// out.
///
/// `update` never throws, allocates or locks, and never returns NaN. While the acceleration or a
/// leg's torques are not usable, the belief relaxes to the prior and the status gives the reason.
class LoadLogistic : public ContactEstimator {
 public:
  /// Throws InputError for a curve that is not finite, a rate, length or largest force that is not
  /// positive, a negative time constant, and a threshold outside (0, 1).
  explicit LoadLogistic(const LogisticCurve& curve, const LoadLogisticConfig& config = {});

  void reset() noexcept override;

 private:
  const Belief& estimate(const Signals& signals) noexcept override;

  LogisticCurve curve_;  ///< of the force (N)
  double threshold_;
  WheelLoads loads_;
  Belief belief_;
};

/// The configuration of the loads that `LoadLogistic` uses.
[[nodiscard]] WheelLoadsConfig loads_of(const LoadLogisticConfig& config) noexcept;

}  // namespace touchdown
