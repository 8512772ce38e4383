#pragma once

#include <array>

#include "estimator/bayes/config.hpp"
#include "estimator/bayes/measurement_model.hpp"
#include "estimator/bayes/noisy_measurement.hpp"
#include "estimator/bayes/recursion.hpp"
#include "estimator/bayes/transition_model.hpp"
#include "estimator/contact_estimator.hpp"
#include "estimator/signal_guard.hpp"
#include "estimator/torque_channel.hpp"

namespace touchdown {

/// The quantities behind one wheel's last update.
struct MeasurementDiagnostics {
  TorqueSample torque;       ///< m_t, Eq. (4) (N·m)
  Likelihoods likelihood;    ///< Eq. (6), floors included
  double p_predicted = 0.5;  ///< bel-bar(S_t = C), Eq. (2a)

  /// P_τ(S_t = C | m_t), Eq. (14).
  [[nodiscard]] double p_measurement() const noexcept {
    return measurement_probability(likelihood);
  }
  [[nodiscard]] Evidence::Measurement evidence() const noexcept {
    return {likelihood.contact, likelihood.no_contact, p_measurement()};
  }
};

/// The paper's Bayes filter, Eq. (1) to (13), for each wheel of the robot. Each wheel has its own
/// torques and belief. Both share the transition model, because there is one accelerometer.
///
/// `update` never throws, allocates or locks, and never returns NaN. A leg with torques that are
/// not finite gets no measurement, and neither leg does while the acceleration is not usable. The
/// belief then relaxes to the prior (`SignalGuard`), and the status gives the reason. After a gap
/// in time the window restarts empty.
class BayesFilter : public ContactEstimator {
 public:
  /// Throws InputError for an invalid configuration.
  explicit BayesFilter(MeasurementModel model,
                       const BayesFilterConfig& config = BayesFilterConfig::robust());

  void reset() noexcept override;
  [[nodiscard]] Evidence evidence() const noexcept override;

  using State = ContactState;

  [[nodiscard]] const Belief& belief() const noexcept { return belief_; }
  [[nodiscard]] const BayesFilterConfig& config() const noexcept { return config_; }
  /// Power, median frequency, P(switch), P(landing) and the transition matrix of the last step.
  [[nodiscard]] const Transition& transition() const noexcept { return transition_.transition(); }
  /// Torques, likelihoods and P_τ of one wheel at the last step that had a measurement.
  [[nodiscard]] const MeasurementDiagnostics& measurement(Side side) const noexcept {
    return measurement_[static_cast<std::size_t>(side)];
  }

 protected:
  const Belief& estimate(const Signals& signals) noexcept override;

  BayesFilterConfig config_;
  NoisyMeasurement model_;
  TorqueMemory torques_;
  TransitionModel transition_;
  SignalGuard guard_;
  std::array<MeasurementDiagnostics, 2> measurement_;
  std::array<ContactState, 2> bel_;
  Belief belief_;
};

}  // namespace touchdown
