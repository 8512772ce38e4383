#include "estimator/phase/prepared_model.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace touchdown {
namespace {

TEST(PhaseNoiseLevels, InterpolateInTheLogarithmOfTheBandwidth) {
  const PhaseNoiseLevels levels = {{0.1, 0.2, 0.8}, 0.1};
  EXPECT_EQ(levels.place(0.0).level, 0U);
  EXPECT_EQ(levels.place(0.0).weight, 0.0F);
  const PhaseNoiseLevel middle = levels.place(std::sqrt(0.4 * 0.4 - 0.01));
  EXPECT_EQ(middle.level, 1U);
  EXPECT_NEAR(middle.weight, 0.5F, 1e-6F);
  const PhaseNoiseLevel beyond = levels.place(100.0);
  EXPECT_EQ(beyond.level, 1U);
  EXPECT_EQ(beyond.weight, 1.0F);
  EXPECT_EQ(PhaseNoiseLevels({{0.1}, 0.1}).place(3.0).weight, 0.0F);
}

}  // namespace
}  // namespace touchdown
