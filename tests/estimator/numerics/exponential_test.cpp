#include "estimator/numerics/exponential.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace touchdown {
namespace {

TEST(Exponential, AgreesWithTheLibraryToTwoUnitsInTheLastPlace) {
  double worst = 0.0;
  for (int i = -690'000; i <= 690'000; ++i) {
    const double x = i * 1.0000001e-3;
    worst = std::max(worst, std::abs(exponential(x) / std::exp(x) - 1.0));
  }
  EXPECT_LT(worst, 4.5e-16);
  EXPECT_EQ(exponential(0.0), 1.0);
}

TEST(Exponential, IsBoundedEverywhere) {
  for (const double x : {-HUGE_VAL, -1e300, -701.0, std::nan("")}) {
    EXPECT_EQ(exponential(x), exponential(-700.0)) << x;
  }
  for (const double x : {HUGE_VAL, 1e300, 701.0}) {
    EXPECT_EQ(exponential(x), exponential(700.0)) << x;
  }
  EXPECT_GT(exponential(-700.0), 0.0);
  EXPECT_TRUE(std::isfinite(exponential(700.0)));
}

}  // namespace
}  // namespace touchdown
