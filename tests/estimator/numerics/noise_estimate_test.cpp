#include "estimator/numerics/noise_estimate.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/estimator/random.hpp"

namespace touchdown {
namespace {

class NoiseOf : public testing::TestWithParam<double> {};

TEST_P(NoiseOf, GaussianNoiseIsFoundWithinAFewPercent) {
  const double sigma = GetParam();
  NoiseEstimate<4> estimate(0.02, 6.4, 0.01, 100.0);
  test::Normal normal(3);
  double mean = 0.0;
  for (int k = 0; k < 8000; ++k) {
    const double smooth = 5.0 * std::sin(0.01 * k);
    std::array<double, 4> x{};
    for (double& value : x) value = smooth + sigma * normal();
    estimate.update(x);
    if (k == 1500) {
      EXPECT_NEAR(estimate.sigma(), sigma, 0.15 * sigma);
      EXPECT_NEAR(estimate.log_sigma(), std::log(estimate.sigma()), 1e-12);
    }
    if (k >= 4000) mean += estimate.sigma() / 4000.0;
  }
  EXPECT_NEAR(mean, sigma, 0.03 * sigma);
}
INSTANTIATE_TEST_SUITE_P(NoiseEstimate, NoiseOf, testing::Values(0.05, 0.25, 1.0, 3.0));

TEST(NoiseEstimate, FallsToTheFloorWithoutNoise) {
  NoiseEstimate<1> estimate(0.1, 16.0, 0.01, 100.0);
  test::Normal normal(1);
  for (int k = 0; k < 2000; ++k) estimate.update({5.0 * normal()});
  EXPECT_GT(estimate.sigma(), 4.0);
  for (int k = 0; k < 2000; ++k) estimate.update({9.81 + 0.001 * k});
  EXPECT_EQ(estimate.sigma(), 0.1);
}

TEST(NoiseEstimate, IsHardlyMovedByShocksAndBadSamples) {
  NoiseEstimate<1> estimate(0.02, 16.0, 0.01, 100.0);
  test::Normal normal(2);
  for (int k = 0; k < 6000; ++k) {
    double x = normal();
    if (k % 1000 < 10) x += 300.0;
    if (k % 500 == 0) x = std::nan("");
    if (k % 700 == 0) x = HUGE_VAL;
    estimate.update({x});
    ASSERT_TRUE(std::isfinite(estimate.sigma()));
  }
  EXPECT_NEAR(estimate.sigma(), 1.0, 0.25);
}

TEST(NoiseEstimate, StaysBelowItsCeiling) {
  NoiseEstimate<1> estimate(0.1, 16.0, 0.01, 100.0);
  test::Normal normal(4);
  for (int k = 0; k < 3000; ++k) estimate.update({1e6 * normal()});
  EXPECT_GE(estimate.sigma(), 16.0);
  EXPECT_LE(estimate.sigma(), 16.5);
}

}  // namespace
}  // namespace touchdown
