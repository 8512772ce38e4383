#include "estimator/force/logistic_regression.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "tests/estimator/random.hpp"

namespace touchdown {
namespace {

double logit(double p) { return std::log(p / (1.0 - p)); }

struct Data {
  std::vector<double> x;
  std::vector<std::uint8_t> one;

  /// `ones` of `all` at this place.
  void add(double place, int ones, int all) {
    for (int i = 0; i < all; ++i) {
      x.push_back(place);
      one.push_back(i < ones ? 1 : 0);
    }
  }
};

TEST(LogisticRegression, GoesThroughTheFrequenciesOfTwoGroups) {
  Data data;
  data.add(-1.0, 30, 100);
  data.add(2.0, 160, 200);
  const LogisticCurve curve = fit_logistic(data.x, data.one, 0.0);
  EXPECT_NEAR(curve(-1.0), 0.3, 1e-12);
  EXPECT_NEAR(curve(2.0), 0.8, 1e-12);
  EXPECT_NEAR(curve.slope, (logit(0.8) - logit(0.3)) / 3.0, 1e-9);
}

TEST(LogisticRegression, OfABalancedProblemHasItsMiddleAtZero) {
  Data data;
  data.add(-4.0, 10, 100);
  data.add(4.0, 90, 100);
  const LogisticCurve curve = fit_logistic(data.x, data.one, 0.0);
  EXPECT_NEAR(curve.intercept, 0.0, 1e-12);
  EXPECT_NEAR(curve.slope, logit(0.9) / 4.0, 1e-9);
}

Data overlapping() {
  Data data;
  test::Normal normal(3);
  for (int i = 0; i < 4000; ++i) {
    const bool one = i % 5 != 0;
    data.x.push_back((one ? 26.0 : 0.0) + 14.0 * normal());
    data.one.push_back(one ? 1 : 0);
  }
  return data;
}

TEST(LogisticRegression, EndsAtAZeroGradient) {
  const Data data = overlapping();
  const auto n = static_cast<double>(data.x.size());
  double mean = 0.0;
  for (const double x : data.x) mean += x / n;
  double variance = 0.0;
  for (const double x : data.x) variance += (x - mean) * (x - mean) / n;
  for (const double ridge : {0.0, 1e-6, 0.1}) {
    const LogisticCurve curve = fit_logistic(data.x, data.one, ridge);
    double by_intercept = 0.0;
    double by_slope = ridge * curve.slope * variance;
    for (std::size_t i = 0; i < data.x.size(); ++i) {
      const double apart = curve(data.x[i]) - static_cast<double>(data.one[i]);
      by_intercept += apart / n;
      by_slope += apart * data.x[i] / n;
    }
    EXPECT_NEAR(by_intercept, 0.0, 1e-9) << ridge;
    EXPECT_NEAR(by_slope, 0.0, 1e-9) << ridge;
  }
}

TEST(LogisticRegression, FollowsTheScaleOfItsInput) {
  const Data data = overlapping();
  std::vector<double> scaled;
  for (const double x : data.x) scaled.push_back(1e3 * x + 7.0);
  const LogisticCurve one = fit_logistic(data.x, data.one);
  const LogisticCurve other = fit_logistic(scaled, data.one);
  EXPECT_NEAR(1e3 * other.slope, one.slope, 1e-9);
  EXPECT_NEAR(other(1e3 * 9.0 + 7.0), one(9.0), 1e-9);
}

TEST(LogisticRegression, OfSeparableDataIsAsSteepAsTheRidgeAllows) {
  Data data;
  data.add(-1.0, 0, 50);
  data.add(1.0, 50, 50);
  for (const double ridge : {1e-6, 1e-3}) {
    const LogisticCurve curve = fit_logistic(data.x, data.one, ridge);
    // d/ds of log(1 + exp(−s)) + ridge s²/2 is zero.
    EXPECT_NEAR(1.0 / (1.0 + std::exp(curve.slope)), ridge * curve.slope, 1e-12);
    EXPECT_NEAR(curve.intercept, 0.0, 1e-9);
  }
  Data apart;  // classes of other sizes, far apart and far from zero
  apart.add(1000.0, 0, 900);
  apart.add(1001.0, 3, 3);
  const LogisticCurve curve = fit_logistic(apart.x, apart.one);
  EXPECT_TRUE(std::isfinite(curve.slope) && std::isfinite(curve.intercept));
  EXPECT_LT(curve(1000.0), 0.01);
  EXPECT_GT(curve(1001.0), 0.9);
}

TEST(LogisticRegression, OfAConstantIsTheShareOfOnes) {
  Data data;
  data.add(5.0, 3, 4);
  const LogisticCurve curve = fit_logistic(data.x, data.one);
  EXPECT_EQ(curve.slope, 0.0);
  EXPECT_NEAR(curve(123.0), 0.75, 1e-12);
}

TEST(LogisticRegression, RefusesInvalidValues) {
  Data data;
  data.add(0.0, 1, 2);
  EXPECT_THROW(static_cast<void>(fit_logistic(data.x, data.one, -1.0)), InputError);
  EXPECT_THROW(static_cast<void>(fit_logistic({}, {})), InputError);
  EXPECT_THROW(static_cast<void>(fit_logistic(data.x, std::vector<std::uint8_t>{1})), InputError);
  EXPECT_THROW(static_cast<void>(fit_logistic(data.x, std::vector<std::uint8_t>{1, 1})),
               InputError);
  data.x[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(static_cast<void>(fit_logistic(data.x, data.one)), InputError);
}

}  // namespace
}  // namespace touchdown
