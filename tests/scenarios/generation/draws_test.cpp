#include "scenarios/generation/draws.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace touchdown::scenarios {
namespace {

TEST(Draws, DependOnSeedFamilyNumberAttemptListAndQuantity) {
  std::set<double> values;
  const auto add = [&](const Draws& draws) { values.insert(draws.between("rise", 0.0, 1.0)); };
  add(Draws(1, "stairs", 0, 0));
  add(Draws(2, "stairs", 0, 0));
  add(Draws(1, "kerbs", 0, 0));
  add(Draws(1, "stairs", 1, 0));
  add(Draws(1, "stairs", 0, 1));
  add(Draws(1, "stairs", 0, 0).of("part", 0));
  add(Draws(1, "stairs", 0, 0).of("part", 1));
  add(Draws(1, "stairs", 0, 0).of("other", 0));
  values.insert(Draws(1, "stairs", 0, 0).between("run", 0.0, 1.0));
  add(Draws(1, "stairs", 0, 0));  // the only one that is there already
  EXPECT_EQ(values.size(), 9U);
}

/// Values of one quantity over many scenarios.
template <typename Draw>
std::vector<double> sample(Draw draw) {
  std::vector<double> values;
  for (std::uint64_t number = 0; number < 4000; ++number) {
    values.push_back(static_cast<double>(draw(Draws(7, "stairs", number, 0))));
  }
  std::sort(values.begin(), values.end());
  return values;
}

TEST(Draws, AreUniformInTheirRange) {
  const auto values = sample([](const Draws& d) { return d.between("a", -2.0, 6.0); });
  EXPECT_GE(values.front(), -2.0);
  EXPECT_LE(values.back(), 6.0);
  for (const double share : {0.1, 0.5, 0.9}) {  // five standard errors of a quantile at most
    EXPECT_NEAR(values[static_cast<std::size_t>(4000 * share)], -2.0 + 8.0 * share, 0.32) << share;
  }
}

TEST(Draws, OfALogarithmHaveTheGeometricMeanAsTheirMedian) {
  const auto values = sample([](const Draws& d) { return d.log_between("a", 0.2, 10.0); });
  EXPECT_GE(values.front(), 0.2);
  EXPECT_LE(values.back(), 10.0);
  EXPECT_NEAR(std::log(values[2000]), 0.5 * std::log(0.2 * 10.0), 0.16);
}

TEST(Draws, OfWholeNumbersReachBothEnds) {
  const auto values = sample([](const Draws& d) { return d.whole("a", 3, 7); });
  for (const double value : {3.0, 4.0, 5.0, 6.0, 7.0}) {
    EXPECT_NEAR(static_cast<double>(std::count(values.begin(), values.end(), value)), 800, 130);
  }
  EXPECT_EQ(values.front(), 3.0);
  EXPECT_EQ(values.back(), 7.0);
}

TEST(Draws, HappenAsOftenAsTheirProbability) {
  const auto values = sample([](const Draws& d) { return d.happens("a", 0.3) ? 1 : 0; });
  EXPECT_NEAR(static_cast<double>(std::count(values.begin(), values.end(), 1.0)), 1200, 150);
}

}  // namespace
}  // namespace touchdown::scenarios
