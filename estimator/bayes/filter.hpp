#pragma once

#include <array>

#include "estimator/bayes/config.hpp"
#include "estimator/bayes/measurement_model.hpp"
#include "estimator/bayes/transition_model.hpp"
#include "estimator/contact_estimator.hpp"
#include "estimator/signal_guard.hpp"
#include "estimator/torque_channel.hpp"

namespace touchdown {

/// What one wheel's last update was computed from.
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

/// The paper's Bayes filter, Eq. (1) to (13), for each wheel of the robot. The two wheels have
/// their own torques and beliefs; they share the transition model, because there is one
/// accelerometer.
///
/// `update` never throws, allocates or locks, and never returns NaN. A leg whose torques are not
/// finite, or both legs while the acceleration is not usable, get no measurement: their belief
/// relaxes to the prior (`SignalGuard`), and the status says why. After a gap in time the window
/// restarts empty.
class BayesFilter : public ContactEstimator {
 public:
  /// Throws InputError for a configuration that makes no sense.
  explicit BayesFilter(MeasurementModel model,
                       const BayesFilterConfig& config = BayesFilterConfig::robust());

  void reset() noexcept override;
  const Belief& update(const Signals& signals) noexcept override;
  [[nodiscard]] Evidence evidence() const noexcept override;

  /// bel(S_t) for both values of S_t. Both are kept, because next to certainty 1 − bel(C) would be
  /// nothing but rounding error, and that is what the next prediction starts from.
  struct State {
    double contact = 0.5;
    double no_contact = 0.5;
  };

  [[nodiscard]] const Belief& belief() const noexcept { return belief_; }
  [[nodiscard]] const BayesFilterConfig& config() const noexcept { return config_; }
  /// Power, median frequency, P(switch), P(landing) and the transition matrix of the last step.
  [[nodiscard]] const Transition& transition() const noexcept { return transition_.transition(); }
  /// Torques, likelihoods and P_τ of one wheel at the last step that had a measurement.
  [[nodiscard]] const MeasurementDiagnostics& measurement(Side side) const noexcept {
    return measurement_[static_cast<std::size_t>(side)];
  }

 private:
  BayesFilterConfig config_;
  MeasurementModel model_;
  TransitionModel transition_;
  SignalGuard guard_;
  std::array<TorqueChannel, 2> torque_;
  std::array<MeasurementDiagnostics, 2> measurement_;
  std::array<State, 2> bel_;
  Belief belief_;
};

}  // namespace touchdown
