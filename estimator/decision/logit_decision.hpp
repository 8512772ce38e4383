#pragma once

#include <array>
#include <cstddef>

#include "estimator/decision/config.hpp"
#include "estimator/decision/feature_extractor.hpp"
#include "estimator/signals.hpp"

namespace touchdown {

/// The common part of estimators that compute a logit for each wheel from the inputs of
/// `FeatureExtractor`. It low-passes the logit, more strongly the noisier the torques, and decides
/// by its operating point.
///
/// If a leg is unusable or frozen, its own belief relaxes to the prior, and the other wheel's
/// inputs take both legs as alike. Without a usable IMU both beliefs relax. The status gives the
/// reason. Afterwards, as after a gap, the features continue from their earlier state. Never
/// throws, allocates or locks.
class LogitDecision {
 public:
  /// Throws InputError for an invalid configuration.
  explicit LogitDecision(const DecisionConfig& config);
  /// The same, with the load by the servo law if the model has it.
  LogitDecision(DecisionConfig config, bool has_servo_load);

  void reset() noexcept;

  /// Takes the signals of one step. Returns whether it has inputs: left, right wheel.
  const std::array<bool, 2>& update(const Signals& signals) noexcept;
  /// The features of the step; its inputs have to be computed first.
  [[nodiscard]] FeatureExtractor& features() noexcept { return features_; }
  [[nodiscard]] const FeatureExtractor& features() const noexcept { return features_; }

  /// The belief, given ln P(contact) / P(no contact) of each wheel that has inputs.
  const Belief& decide(const std::array<double, 2>& logit) noexcept;

 private:
  DecisionConfig config_;
  FeatureExtractor features_;
  FeatureExtractor::Step step_;
  std::array<double, 2> logit_{};  ///< low-passed
  std::array<bool, 2> is_started_{};
  std::array<ContactDecision, 2> decision_{};
  Belief belief_;
};

}  // namespace touchdown
