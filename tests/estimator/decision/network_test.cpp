#include "estimator/decision/network.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace touchdown {
namespace {

TEST(DecisionLogit, OfTwoWeightsIsWhatPencilAndPaperSay) {
  DecisionModel model;
  // Two paths from the fourth input to the output, of which rectifiers leave one open.
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

TEST(DecisionModel, WithWeightsThatAreNotFiniteIsRefused) {
  DecisionModel model;
  EXPECT_NO_THROW(check_decision_model(model));
  model.second_weight[17] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(check_decision_model(model), InputError);
}

}  // namespace
}  // namespace touchdown
