#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "estimator/numerics/sliding_dft.hpp"

namespace touchdown {
namespace {

TEST(SquareRoot, AgreesWithTheLibraryToOneUnitInTheLastPlace) {
  double worst = 0.0;
  for (double x = 1e-300; x < 1e300; x *= 1.000937) {
    worst = std::max(worst, std::abs(square_root(x) / std::sqrt(x) - 1.0));
  }
  EXPECT_LE(worst, std::numeric_limits<double>::epsilon());
}

TEST(SquareRoot, IsZeroForZeroAndNextToItForDenormals) {
  EXPECT_EQ(square_root(0.0), 0.0);
  const double tiny = square_root(std::numeric_limits<double>::denorm_min());
  EXPECT_GE(tiny, 0.0);
  EXPECT_LT(tiny, 1e-150);
}

TEST(SquareRoot, OfManyComputesAll) {
  for (const int count : {0, 1, 2, 6, 8, 12, 35, 64}) {
    std::vector<double> root(static_cast<std::size_t>(count), -1.0);
    square_roots(
        count, [](int i) { return 0.25 * i * i; },
        [&root](int i, double value) { root[static_cast<std::size_t>(i)] = value; });
    for (int i = 0; i < count; ++i) {
      EXPECT_NEAR(root[static_cast<std::size_t>(i)], 0.5 * i, 1e-14 * i) << count;
    }
  }
}

}  // namespace
}  // namespace touchdown
