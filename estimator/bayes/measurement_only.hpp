#pragma once

#include <array>

#include "estimator/bayes/filter.hpp"

namespace touchdown {

/// The paper's ablation, Eq. (14): each wheel's contact probability from its current torques alone,
/// P_τ(S_t = C | m_t). It has no transition model and does not use the accelerometer. Where a
/// wheel's torques are not finite, its belief relaxes to 0.5. A gap in time restarts the torque
/// low-pass.
class MeasurementOnly : public BayesFilter {
 public:
  /// Uses the sample rate, measurement, guard and threshold of the configuration. By default the
  /// torques are filtered as in the robust Bayes filter. Throws InputError as that filter does.
  explicit MeasurementOnly(MeasurementModel model,
                           BayesFilterConfig config = BayesFilterConfig::robust());

  [[nodiscard]] Evidence evidence() const noexcept override {
    return {{measurement_[0].evidence(), measurement_[1].evidence()}, {}};
  }

 private:
  const Belief& estimate(const Signals& signals) noexcept override;
};

}  // namespace touchdown
