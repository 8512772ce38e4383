#include "estimator/decision/network.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include "core/error.hpp"

namespace touchdown {

DecisionInputs of_other_wheel(const DecisionInputs& inputs) noexcept {
  constexpr std::size_t of_legs = DecisionPairInputs::of_legs;
  constexpr std::size_t roll = 2 * of_legs + decision_scales;
  DecisionInputs other = inputs;
  std::copy_n(inputs.begin(), of_legs, other.begin() + of_legs);
  std::copy_n(inputs.begin() + of_legs, of_legs, other.begin());
  for (std::size_t i = roll; i < roll + decision_scales; ++i) other[i] = -inputs[i];
  return other;
}

ServoLoadInputs of_other_wheel(const ServoLoadInputs& inputs) noexcept {
  ServoLoadInputs other = inputs;
  std::rotate(other.begin(), other.begin() + decision_scales, other.end());
  return other;
}

PairedDecisionNetwork::PairedDecisionNetwork(const DecisionModel& model) noexcept : model_(model) {
  constexpr std::size_t of_legs = DecisionPairInputs::of_legs;
  for (std::size_t unit = 0; unit < decision_first; ++unit) {
    const auto weight = [&](std::size_t input) {
      return model.first_weight[input * decision_first + unit];
    };
    for (std::size_t i = 0; i < of_legs; ++i) {
      common_[i * decision_first + unit] = 0.5F * (weight(i) + weight(of_legs + i));
      difference_[i * decision_first + unit] = 0.5F * (weight(i) - weight(of_legs + i));
    }
    for (std::size_t i = 0; i < decision_scales; ++i) {
      common_[(of_legs + i) * decision_first + unit] = weight(2 * of_legs + i);
      difference_[(of_legs + i) * decision_first + unit] =
          weight(2 * of_legs + decision_scales + i);
    }
    for (std::size_t i = 0; i < 2; ++i) {
      common_[(of_legs + decision_scales + i) * decision_first + unit] =
          weight(2 * of_legs + 2 * decision_scales + i);
    }
    if (model.servo_weight.empty()) continue;
    for (std::size_t i = 0; i < decision_scales; ++i) {
      const float own = model.servo_weight[i * decision_first + unit];
      const float other = model.servo_weight[(decision_scales + i) * decision_first + unit];
      servo_common_[i * decision_first + unit] = 0.5F * (own + other);
      servo_difference_[i * decision_first + unit] = 0.5F * (own - other);
    }
  }
}

std::array<float, 2> PairedDecisionNetwork::logits(
    const DecisionPairInputs& inputs) const noexcept {
  using Sums = Eigen::Array<float, static_cast<int>(decision_first), 1>;
  using Column = Eigen::Map<const Sums, Eigen::Aligned32>;
  Sums common = Eigen::Map<const Sums>(model_.first_bias.data());
  Sums difference = Sums::Zero();
  for (std::size_t i = 0; i < inputs.difference.size(); ++i) {
    common += inputs.common[i] * Column(common_.data() + i * decision_first);
    difference += inputs.difference[i] * Column(difference_.data() + i * decision_first);
  }
  for (std::size_t i = inputs.difference.size(); i < inputs.common.size(); ++i) {
    common += inputs.common[i] * Column(common_.data() + i * decision_first);
  }
  if (!model_.servo_weight.empty()) {
    for (std::size_t i = 0; i < decision_scales; ++i) {
      common += inputs.servo_common[i] * Column(servo_common_.data() + i * decision_first);
      difference +=
          inputs.servo_difference[i] * Column(servo_difference_.data() + i * decision_first);
    }
  }
  const Sums left = (common + difference).max(0.0F);
  const Sums right = (common - difference).max(0.0F);
  // Four independent sums, so that no addition waits for the one before.
  using SecondSums = Eigen::Array<float, static_cast<int>(decision_second), 1>;
  const auto weights = [&](std::size_t unit) {
    return Eigen::Map<const SecondSums>(model_.second_weight.data() + unit * decision_second);
  };
  SecondSums left_even = Eigen::Map<const SecondSums>(model_.second_bias.data());
  SecondSums right_even = left_even;
  SecondSums left_odd = SecondSums::Zero();
  SecondSums right_odd = left_odd;
  for (std::size_t unit = 0; unit < decision_first; unit += 2) {
    const auto even = static_cast<Eigen::Index>(unit);
    left_even += left[even] * weights(unit);
    right_even += right[even] * weights(unit);
    left_odd += left[even + 1] * weights(unit + 1);
    right_odd += right[even + 1] * weights(unit + 1);
  }
  const Eigen::Map<const SecondSums> last(model_.last_weight.data());
  return {model_.last_bias + ((left_even + left_odd).max(0.0F) * last).sum(),
          model_.last_bias + ((right_even + right_odd).max(0.0F) * last).sum()};
}

void check_decision_model(const DecisionModel& model) {
  if (!model.servo_weight.empty() && model.servo_weight.size() != servo_weights) {
    throw InputError("decision network: expected servo_weight of every input and unit, or none");
  }
  for_each_part(
      [](const char* /*name*/, std::span<const float> numbers) {
        if (std::ranges::all_of(numbers, [](float x) { return std::isfinite(x); })) return;
        throw InputError("decision network: its weights must be finite");
      },
      model);
}

}  // namespace touchdown
