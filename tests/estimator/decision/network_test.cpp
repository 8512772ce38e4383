#include "estimator/decision/network.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "tests/estimator/decision/decision_logit.hpp"
#include "tests/estimator/decision/random_model.hpp"
#include "tests/estimator/random.hpp"

namespace touchdown {
namespace {

using test::decision_logit;

TEST(DecisionLogit, OfTwoWeightsMatchesAHandCalculation) {
  DecisionModel model;
  // Two paths from the fourth input to the output. The rectifiers open one of them.
  model.first_weight[3 * decision_first + 5] = 2.0F;
  model.first_weight[3 * decision_first + 6] = -2.0F;
  model.first_bias[5] = -1.0F;
  model.second_weight[5 * decision_second + 7] = 0.5F;
  model.second_weight[6 * decision_second + 8] = 0.25F;
  model.second_bias[7] = 0.125F;
  model.last_weight[7] = 4.0F;
  model.last_weight[8] = 8.0F;
  model.last_bias = -3.0F;
  DecisionInputs inputs{};
  inputs[3] = 1.5F;  // 2·1.5 − 1 = 2, 2/2 + 1/8 = 9/8, 4·9/8 − 3
  EXPECT_EQ(decision_logit(model, inputs), 1.5F);
  inputs[3] = -2.0F;  // the other path: 4, 1, and 1/8 of the first path's bias
  EXPECT_EQ(decision_logit(model, inputs), 8.0F + 0.5F - 3.0F);
  inputs[3] = 0.0F;
  EXPECT_EQ(decision_logit(model, inputs), -2.5F);
}

TEST(PairedDecisionNetwork, GivesEachWheelTheLogitOfTheNetwork) {
  constexpr std::size_t of_legs = DecisionPairInputs::of_legs;
  test::Normal normal(3);
  for (int round = 0; round < 20; ++round) {
    const DecisionModel model = test::random_model(static_cast<std::uint32_t>(round));
    DecisionInputs of_one{};
    for (float& x : of_one) x = static_cast<float>(normal());
    DecisionInputs of_other = of_one;
    DecisionPairInputs pair;
    for (std::size_t i = 0; i < of_legs; ++i) {
      of_other[i] = of_one[of_legs + i];
      of_other[of_legs + i] = of_one[i];
      pair.common[i] = of_one[i] + of_other[i];
      pair.difference[i] = of_one[i] - of_other[i];
    }
    for (std::size_t i = 0; i < decision_scales; ++i) {
      const std::size_t roll = 2 * of_legs + decision_scales + i;
      of_other[roll] = -of_one[roll];
      pair.common[of_legs + i] = of_one[2 * of_legs + i];
      pair.difference[of_legs + i] = of_one[roll];
    }
    for (std::size_t i = 0; i < 2; ++i) {
      pair.common[of_legs + decision_scales + i] = of_one[decision_inputs - 2 + i];
    }
    const std::array<float, 2> logits = PairedDecisionNetwork(model).logits(pair);
    const float of_left = decision_logit(model, of_one);
    const float of_right = decision_logit(model, of_other);
    EXPECT_NEAR(logits[0], of_left, 1e-4F * (1.0F + std::abs(of_left)));
    EXPECT_NEAR(logits[1], of_right, 1e-4F * (1.0F + std::abs(of_right)));
    EXPECT_NE(of_left, of_right);
  }
}

TEST(DecisionModel, WithWeightsThatAreNotFiniteIsRefused) {
  DecisionModel model;
  EXPECT_NO_THROW(check_decision_model(model));
  model.second_weight[17] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(check_decision_model(model), InputError);
}

TEST(PairedDecisionNetwork, GivesEachWheelTheLogitWithTheServoLoad) {
  test::Normal normal(4);
  for (int round = 0; round < 20; ++round) {
    DecisionModel model = test::random_model(static_cast<std::uint32_t>(round));
    model.servo_weight.resize(servo_weights);
    for (float& weight : model.servo_weight) weight = static_cast<float>(normal());
    ServoLoadInputs left{};
    for (float& x : left) x = static_cast<float>(normal());
    DecisionPairInputs pair;
    for (std::size_t i = 0; i < decision_scales; ++i) {
      pair.servo_common[i] = left[i] + left[decision_scales + i];
      pair.servo_difference[i] = left[i] - left[decision_scales + i];
    }
    const std::array<float, 2> logits = PairedDecisionNetwork(model).logits(pair);
    const float of_left = decision_logit(model, {}, left);
    const float of_right = decision_logit(model, {}, of_other_wheel(left));
    EXPECT_NEAR(logits[0], of_left, 1e-4F * (1.0F + std::abs(of_left)));
    EXPECT_NEAR(logits[1], of_right, 1e-4F * (1.0F + std::abs(of_right)));
    EXPECT_NE(of_left, of_right);
  }
}

TEST(DecisionModel, WithWrongServoWeightsIsRefused) {
  for (const std::size_t size : {std::size_t{1}, servo_weights - 1, servo_weights + 1}) {
    DecisionModel model;
    model.servo_weight.resize(size);
    EXPECT_THROW(check_decision_model(model), InputError) << size;
  }
  DecisionModel model;
  model.servo_weight.resize(servo_weights);
  EXPECT_NO_THROW(check_decision_model(model));
  model.servo_weight[5] = std::numeric_limits<float>::infinity();
  EXPECT_THROW(check_decision_model(model), InputError);
}

}  // namespace
}  // namespace touchdown
