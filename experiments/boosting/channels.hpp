#pragma once

#include <array>
#include <cstddef>

#include "estimator/decision/feature_extractor.hpp"
#include "experiments/boosting/inputs.hpp"

namespace touchdown::experiments {

/// Inputs of boosted trees: exactly those of the recommended estimator, its channels at all time
/// scales and both noise levels. The channel of the servo law is 0 in a fit without it.
class ChannelInputs {
 public:
  static constexpr std::size_t count = decision_inputs + 2 * decision_scales;
  using Features = std::array<float, count>;

  /// Throws InputError for an invalid configuration.
  explicit ChannelInputs(const TreeInputsConfig& config);

  void reset() noexcept { extractor_.reset(); }
  TreeInputsStep update(const Signals& signals) noexcept;

  /// Features with the signs of the left leg, as of the last valid step.
  [[nodiscard]] Features features(std::size_t side) const noexcept;
  /// A belief after `elapsed` seconds without valid signals.
  [[nodiscard]] double relaxed(double p_contact, double elapsed) const noexcept {
    return extractor_.relaxed(p_contact, elapsed);
  }

 private:
  FeatureExtractor extractor_;
};

}  // namespace touchdown::experiments
