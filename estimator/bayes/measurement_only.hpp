#pragma once

#include <array>

#include "estimator/bayes/filter.hpp"

namespace touchdown {

/// The paper's ablation, Eq. (14): each wheel's contact probability from its current torques alone,
/// P_τ(S_t = C | m_t). It has no transition model and does not use the accelerometer. Where a
/// wheel's torques are not finite, its belief relaxes to 0.5. A gap in time restarts the torque
/// low-pass.
class MeasurementOnly : public ContactEstimator {
 public:
  /// Uses the sample rate, measurement, guard and threshold of the configuration. By default the
  /// torques are filtered as in the robust Bayes filter. Throws InputError as
  /// `check_measurement_config` and `SignalGuard` do.
  explicit MeasurementOnly(MeasurementModel model,
                           const BayesFilterConfig& config = BayesFilterConfig::robust());

  void reset() noexcept override;
  [[nodiscard]] Evidence evidence() const noexcept override {
    return {{measurement_[0].evidence(), measurement_[1].evidence()}, {}};
  }

  [[nodiscard]] const Belief& belief() const noexcept { return belief_; }
  [[nodiscard]] const BayesFilterConfig& config() const noexcept { return config_; }
  [[nodiscard]] const MeasurementDiagnostics& measurement(Side side) const noexcept {
    return measurement_[static_cast<std::size_t>(side)];
  }

 private:
  const Belief& estimate(const Signals& signals) noexcept override;

  BayesFilterConfig config_;
  NoisyMeasurement model_;
  TorqueMemory torques_;
  SignalGuard guard_;
  std::array<MeasurementDiagnostics, 2> measurement_;
  Belief belief_;
};

}  // namespace touchdown
