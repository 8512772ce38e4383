#include "scoring/exact_share.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace touchdown::scoring {
namespace {

TEST(ExactShare, MatchesTheTablesOfClopperAndPearson) {
  const Interval half = exact_share(5, 10, 0.95);
  EXPECT_EQ(half.estimate, 0.5);
  EXPECT_NEAR(half.low, 0.1871, 5e-5);
  EXPECT_NEAR(half.high, 0.8129, 5e-5);
  const Interval few = exact_share(3, 40, 0.95);
  EXPECT_NEAR(few.low, 0.0157, 5e-5);
  EXPECT_NEAR(few.high, 0.2039, 5e-5);
}

TEST(ExactShare, OfNoneAndOfAllHasOneEndInClosedForm) {
  const Interval all = exact_share(8, 8, 0.95);
  EXPECT_NEAR(all.low, std::pow(0.025, 1.0 / 8.0), 1e-12);
  EXPECT_EQ(all.high, 1.0);
  const Interval none = exact_share(0, 8, 0.95);
  EXPECT_EQ(none.low, 0.0);
  EXPECT_NEAR(none.high, 1.0 - std::pow(0.025, 1.0 / 8.0), 1e-12);
  EXPECT_NEAR(exact_share(1, 1, 0.95).low, 0.025, 1e-12);
}

TEST(ExactShare, OfManyTrialsMatchesTheNormalDistribution) {
  const Interval many = exact_share(30'000, 100'000, 0.95);
  const double half_width = 1.96 * std::sqrt(0.3 * 0.7 / 1e5);
  EXPECT_NEAR(many.low, 0.3 - half_width, 0.02 * half_width);
  EXPECT_NEAR(many.high, 0.3 + half_width, 0.02 * half_width);
}

TEST(ExactShare, WithoutTrialsIsNaN) { EXPECT_TRUE(std::isnan(exact_share(0, 0, 0.95).low)); }

}  // namespace
}  // namespace touchdown::scoring
