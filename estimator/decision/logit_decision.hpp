#pragma once

#include <array>
#include <cstddef>

#include "estimator/decision/config.hpp"
#include "estimator/decision/feature_extractor.hpp"
#include "estimator/signals.hpp"

namespace touchdown {

/// What estimators share that give each wheel a logit of what `FeatureExtractor` hear: the logit is
/// low-passed the more, the noisier the torques, and decided by hysteresis.
///
/// A leg that cannot be used, or that has frozen, is taken to fare like the other one by the other
/// one's wheel, while its own belief relaxes to the prior; without a usable IMU both do. The status
/// says why. After that, as after a gap, it goes on from what it knew before. Never throws,
/// allocates or locks.
class LogitDecision {
 public:
  /// Throws InputError for a configuration that makes no sense.
  explicit LogitDecision(const DecisionConfig& config);

  void reset() noexcept;

  /// Hears a step. Returns whether there are inputs of it: left, right.
  const std::array<bool, 2>& update(const Signals& signals) noexcept;
  /// Its inputs: of the left wheel, which are the other one's in another order; of both.
  [[nodiscard]] const DecisionInputs& left_inputs() const noexcept { return features_.left_inputs(); }
  [[nodiscard]] const DecisionPairInputs& pair_inputs() const noexcept {
    return features_.pair_inputs();
  }
  /// What is believed, given ln P(contact) / P(no contact) of each wheel that has inputs.
  const Belief& decide(const std::array<double, 2>& logit) noexcept;

 private:
  DecisionConfig config_;
  FeatureExtractor features_;
  FeatureExtractor::Step step_;
  std::array<double, 2> logit_{};  ///< low-passed
  std::array<bool, 2> is_started_{};
  Belief belief_;
};

}  // namespace touchdown
