#pragma once

#include <array>
#include <cstddef>

namespace touchdown {

/// What the network hears of one wheel: of its own leg four channels, of the other leg the same,
/// the vertical acceleration and the roll rate, …
inline constexpr std::size_t decision_leg_channels = 4;
inline constexpr std::size_t decision_channels = 2 * decision_leg_channels + 2;
/// … each at so many time scales, and how noisy torques and acceleration are.
inline constexpr std::size_t decision_scales = 8;
inline constexpr std::size_t decision_inputs = decision_channels * decision_scales + 2;
inline constexpr std::size_t decision_first = 32;
inline constexpr std::size_t decision_second = 16;

using DecisionInputs = std::array<float, decision_inputs>;

/// A perceptron of two rectified layers and one output, the same for both wheels. Weights lie by
/// input: those from one input to all outputs of its layer are neighbours.
struct DecisionModel {
  std::array<float, decision_inputs * decision_first> first_weight{};
  std::array<float, decision_first> first_bias{};
  std::array<float, decision_first * decision_second> second_weight{};
  std::array<float, decision_second> second_bias{};
  std::array<float, decision_second> last_weight{};
  float last_bias = 0.0F;

  bool operator==(const DecisionModel&) const = default;
};

/// ln P(contact) / P(no contact) of one wheel.
[[nodiscard]] float decision_logit(const DecisionModel& model,
                                   const DecisionInputs& inputs) noexcept;

/// Throws InputError for weights that are not finite.
void check_decision_model(const DecisionModel& model);

}  // namespace touchdown
