#include "estimator/numerics/sine.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace touchdown {
namespace {

TEST(SineAndCosine, AgreeWithTheLibraryToTwoUnitsInTheLastPlaceOfOne) {
  double worst = 0.0;
  for (const double range : {1e-6, 1.0, 7.0, 1e3, 1e5}) {
    for (int i = -100'000; i <= 100'000; ++i) {
      const double x = range * 1e-5 * i;
      const SineCosine found = sine_and_cosine(x);
      worst = std::max(
          {worst, std::abs(found.sine - std::sin(x)), std::abs(found.cosine - std::cos(x))});
    }
  }
  EXPECT_LT(worst, 4.5e-16);
}

TEST(SineAndCosine, OfZeroAndOfNan) {
  EXPECT_EQ(sine_and_cosine(0.0).sine, 0.0);
  EXPECT_EQ(sine_and_cosine(0.0).cosine, 1.0);
  EXPECT_TRUE(std::isnan(sine_and_cosine(std::nan("")).sine));
  EXPECT_TRUE(std::isnan(sine_and_cosine(std::nan("")).cosine));
}

}  // namespace
}  // namespace touchdown
