#include "estimator/numerics/sliding_dft.hpp"

#include <algorithm>
#include <complex>
#include <cstdio>
#include <deque>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "tests/estimator/random.hpp"

namespace touchdown {
namespace {

using test::Normal;

/// The definition, with its angles reduced exactly.
std::vector<std::complex<double>> plain_dft(const std::deque<double>& window) {
  const auto n = static_cast<int>(window.size());
  std::vector<std::complex<double>> x(static_cast<std::size_t>(n / 2 + 1));
  for (int k = 0; k <= n / 2; ++k) {
    for (int i = 0; i < n; ++i) {
      const double angle = -2.0 * std::numbers::pi * ((k * i) % n) / n;
      x[static_cast<std::size_t>(k)] +=
          window[static_cast<std::size_t>(i)] * std::polar(1.0, angle);
    }
  }
  return x;
}

/// Largest difference between both transforms over the largest magnitude without bin 0.
double relative_error(const SlidingDft& dft, const std::deque<double>& window) {
  const std::vector<std::complex<double>> expected = plain_dft(window);
  double difference = 0.0;
  double scale = 0.0;
  for (int k = 0; k < dft.bins(); ++k) {
    const auto& x = expected[static_cast<std::size_t>(k)];
    difference =
        std::max(difference, std::abs(x - std::complex<double>(dft.real(k), dft.imaginary(k))));
    scale = std::max(scale, k > 0 ? std::abs(x) : 0.0);
  }
  return difference / scale;
}

class SlidingDftWindow : public testing::TestWithParam<int> {};

TEST_P(SlidingDftWindow, MatchesAPlainDftWhileItFillsAndSlides) {
  const int n = GetParam();
  SlidingDft dft(n);
  ASSERT_EQ(dft.bins(), n / 2 + 1);
  std::deque<double> window(static_cast<std::size_t>(n), 0.0);
  Normal normal(5);
  for (int t = 0; t < 3 * n + 5; ++t) {
    const double sample = 0.5 + normal();
    dft.push(sample);
    window.pop_front();
    window.push_back(sample);
    ASSERT_LT(relative_error(dft, window), 1e-12) << t;
    for (int k = 0; k < dft.bins(); ++k) {
      ASSERT_NEAR(dft.squared_magnitude(k),
                  dft.real(k) * dft.real(k) + dft.imaginary(k) * dft.imaginary(k), 1e-9);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(AnyLength, SlidingDftWindow,
                         testing::Values(2, 3, 5, 16, 17, 64, 100, 127, 128, 129, 200));

TEST(SlidingDft, MatchesAPlainDftThroughAShockOverAMillionSteps) {
  SlidingDft dft(128);
  std::deque<double> window(128, 0.0);
  Normal normal(6);
  double worst = 0.0;
  for (int t = 0; t < 1'000'000; ++t) {
    const double shock = t % 100'000 == 50'000 ? 300.0 : 0.0;
    const double sample = 9.81 + shock + 0.1 * normal();
    dft.push(sample);
    window.pop_front();
    window.push_back(sample);
    if (t % 997 == 996 || (t > 50'000 && t < 50'300)) {
      worst = std::max(worst, relative_error(dft, window));
    }
  }
  EXPECT_LT(worst, 1e-9);
  std::printf("largest relative error: %.2g\n", worst);
}

TEST(SlidingDft, RefusesAWindowWithoutFrequencies) {
  EXPECT_THROW(SlidingDft(1), InputError);
  EXPECT_THROW(SlidingDft(0), InputError);
  EXPECT_THROW(SlidingDft(-5), InputError);
}

}  // namespace
}  // namespace touchdown
