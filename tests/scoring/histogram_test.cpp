#include "scoring/histogram.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "noise/gaussian.hpp"

namespace touchdown::scoring {
namespace {

Histogram normal_sample(double mean, double deviation, std::uint64_t seed) {
  Histogram histogram(-20.0, 20.0, 8000);
  const noise::NoiseKey key{.seed = seed, .run = 0};
  for (std::uint64_t k = 0; k < 200'000; ++k) {
    histogram.add(
        mean + deviation * noise::standard_normal(key, noise::NoiseChannel::left_hip_position, k));
  }
  return histogram;
}

TEST(Wasserstein, OfAShiftIsTheShift) {
  Histogram a(-1.0, 1.0, 200);
  Histogram b(-1.0, 1.0, 200);
  for (int i = 0; i < 50; ++i) {
    a.add(-0.495 + 0.01 * i);
    b.add(-0.495 + 0.01 * i + 0.37);
  }
  EXPECT_NEAR(wasserstein_distance(a, b), 0.37, 1e-9);
  EXPECT_NEAR(wasserstein_distance(b, a), 0.37, 1e-9);
  EXPECT_DOUBLE_EQ(wasserstein_distance(a, a), 0.0);
}

TEST(Wasserstein, OfPointMassesIsTheWorkOfMovingThem) {
  Histogram a(0.0, 10.0, 1000);
  Histogram b(0.0, 10.0, 1000);
  for (int i = 0; i < 4; ++i) a.add(1.005);
  for (int i = 0; i < 3; ++i) b.add(1.005);
  b.add(9.005);  // a quarter of the mass, 8 away
  EXPECT_NEAR(wasserstein_distance(a, b), 2.0, 1e-9);
}

TEST(Wasserstein, OfGaussiansIsTheClosedForm) {
  // Same mean: |s1 − s2| · sqrt(2/π). Same deviation: |m1 − m2|.
  EXPECT_NEAR(wasserstein_distance(normal_sample(0.0, 1.0, 1), normal_sample(0.0, 2.5, 2)),
              1.5 * std::sqrt(2.0 / std::numbers::pi), 0.02);
  EXPECT_NEAR(wasserstein_distance(normal_sample(-0.5, 1.0, 3), normal_sample(0.7, 1.0, 4)), 1.2,
              0.02);
}

TEST(Wasserstein, ComparesSharesNotCounts) {
  Histogram few(0.0, 1.0, 10);
  Histogram many(0.0, 1.0, 10);
  few.add(0.55);
  for (int i = 0; i < 1000; ++i) many.add(0.55);
  EXPECT_DOUBLE_EQ(wasserstein_distance(few, many), 0.0);
  EXPECT_DOUBLE_EQ(overlap(few.shares(1), many.shares(1)), 1.0);
}

TEST(Wasserstein, OfNothingIsNotDefined) {
  Histogram some(0.0, 1.0, 10);
  some.add(0.5);
  some.add(std::nan(""));
  EXPECT_EQ(some.total(), 1);
  EXPECT_TRUE(std::isnan(wasserstein_distance(some, Histogram(0.0, 1.0, 10))));
  EXPECT_TRUE(std::isnan(overlap(Histogram().shares(1), some.shares(1))));
}

TEST(Overlap, OfUniformsIsTheirCommonPart) {
  Histogram a(0.0, 2.0, 200);
  Histogram b(0.0, 2.0, 200);
  for (int i = 0; i < 100; ++i) {
    a.add(0.005 + 0.01 * i);
    b.add(0.305 + 0.01 * i);
  }
  EXPECT_NEAR(overlap(a.shares(1), b.shares(1)), 0.7, 1e-9);
  EXPECT_NEAR(overlap(a.shares(10), b.shares(10)), 0.7, 1e-9);
  EXPECT_NEAR(overlap(a.shares(200), b.shares(200)), 1.0, 1e-9);
}

TEST(Histogram, KeepsWhatLiesBeyondAtItsEnds) {
  Histogram histogram(0.0, 1.0, 4);
  for (const double value : {-5.0, 0.1, 1.0, 1e300}) histogram.add(value);
  EXPECT_EQ(histogram.count(), (std::vector<std::int64_t>{2, 0, 0, 2}));
}

}  // namespace
}  // namespace touchdown::scoring
