#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <tuple>
#include <vector>

namespace touchdown {

/// The network's inputs for one wheel: four channels of its own leg, the same four of the other
/// leg, the vertical acceleration and the roll rate, …
inline constexpr std::size_t decision_leg_channels = 4;
inline constexpr std::size_t decision_channels = 2 * decision_leg_channels + 2;
/// … each at this many time scales, and the noise levels of torques and acceleration.
inline constexpr std::size_t decision_scales = 8;
inline constexpr std::size_t decision_inputs = decision_channels * decision_scales + 2;
inline constexpr std::size_t decision_first = 24;
inline constexpr std::size_t decision_second = 16;

using DecisionInputs = std::array<float, decision_inputs>;

/// The optional channel: the load by the servo law of the own leg, then of the other leg, each at
/// all time scales.
using ServoLoadInputs = std::array<float, 2 * decision_scales>;

/// The inputs of the other wheel, from those of one: the legs change places, and the roll rate
/// changes its sign.
[[nodiscard]] DecisionInputs of_other_wheel(const DecisionInputs& inputs) noexcept;
[[nodiscard]] ServoLoadInputs of_other_wheel(const ServoLoadInputs& inputs) noexcept;

/// A perceptron with two rectified layers and one output, the same for both wheels. Weights are
/// stored by input: those from one input to all outputs of its layer are neighbours.
struct DecisionModel {
  std::array<float, decision_inputs * decision_first> first_weight{};
  std::array<float, decision_first> first_bias{};
  std::array<float, decision_first * decision_second> second_weight{};
  std::array<float, decision_second> second_bias{};
  std::array<float, decision_second> last_weight{};
  float last_bias = 0.0F;
  /// Of the first layer, from `ServoLoadInputs`; empty without this channel.
  std::vector<float> servo_weight = {};

  bool operator==(const DecisionModel&) const = default;
};

/// Calls `part(name, numbers...)` with the same parameters of all models, part by part.
template <typename Part, typename... Models>
void for_each_part(const Part& part, Models&... models) {
  part("first_weight", std::span(models.first_weight)...);
  part("first_bias", std::span(models.first_bias)...);
  part("second_weight", std::span(models.second_weight)...);
  part("second_bias", std::span(models.second_bias)...);
  part("last_weight", std::span(models.last_weight)...);
  part("last_bias", std::span(&models.last_bias, 1)...);
  part("servo_weight", std::span(models.servo_weight)...);
}

inline constexpr std::size_t servo_weights = std::tuple_size_v<ServoLoadInputs> * decision_first;

/// The inputs of both wheels, split into a common part and a difference: for each channel of a leg
/// the sum and the difference, left − right, of both legs.
struct DecisionPairInputs {
  static constexpr std::size_t of_legs = decision_leg_channels * decision_scales;

  /// Sums; then the vertical acceleration, then how noisy torques and acceleration are.
  std::array<float, of_legs + decision_scales + 2> common{};
  /// Differences; then the roll rate.
  std::array<float, of_legs + decision_scales> difference{};
  /// Sum and difference of the legs' `ServoLoadInputs`.
  std::array<float, decision_scales> servo_common{};
  std::array<float, decision_scales> servo_difference{};
};

/// Evaluates the network for both wheels at once. Their inputs are the same numbers in another
/// order, so with
///
///     W_own x_own + W_other x_other = (W_own + W_other)/2 · (x_own + x_other)
///                                   + (W_own − W_other)/2 · (x_own − x_other)
///
/// the first layer of both wheels takes as many products as that of one.
class PairedDecisionNetwork {
 public:
  explicit PairedDecisionNetwork(const DecisionModel& model) noexcept;

  /// ln P(contact) / P(no contact) of the left and of the right wheel.
  [[nodiscard]] std::array<float, 2> logits(const DecisionPairInputs& inputs) const noexcept;

 private:
  template <std::size_t inputs>
  using Weights = std::array<float, inputs * decision_first>;

  alignas(32) Weights<std::tuple_size_v<decltype(DecisionPairInputs::common)>> common_{};
  alignas(32) Weights<std::tuple_size_v<decltype(DecisionPairInputs::difference)>> difference_{};
  alignas(32) Weights<decision_scales> servo_common_{};
  alignas(32) Weights<decision_scales> servo_difference_{};
  DecisionModel model_;
};

/// Throws InputError for weights that are not finite, and for a wrong number of `servo_weight`.
void check_decision_model(const DecisionModel& model);

}  // namespace touchdown
