#include "experiments/boosting/channels.hpp"

#include <algorithm>

namespace touchdown::experiments {

ChannelInputs::ChannelInputs(const TreeInputsConfig& config)
    : extractor_(DecisionConfig{.sample_rate = config.sample_rate,
                                .geometry = config.legs,
                                .servo_load = config.servo_load}) {}

TreeInputsStep ChannelInputs::update(const Signals& signals) noexcept {
  const FeatureExtractor::Step step = extractor_.update(signals);
  if (step.is_valid[0] || step.is_valid[1]) extractor_.compute_inputs();
  return {step.status, step.elapsed, step.is_valid};
}

ChannelInputs::Features ChannelInputs::features(std::size_t side) const noexcept {
  Features features;
  const DecisionInputs inputs = extractor_.inputs(side);
  const ServoLoadInputs servo = extractor_.servo_load(side);
  std::copy(servo.begin(), servo.end(), std::copy(inputs.begin(), inputs.end(), features.begin()));
  return features;
}

}  // namespace touchdown::experiments
