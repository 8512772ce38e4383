#include "noise/gaussian.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <vector>

#include <Random123/philox.h>
#include <gtest/gtest.h>

namespace touchdown::noise {
namespace {

constexpr std::size_t most_draws = 1'000'000;

std::vector<double> normals(const NoiseKey& key, NoiseChannel channel,
                            std::size_t count = most_draws) {
  std::vector<double> values(count);
  fill_standard_normal(key, channel, 0, values);
  return values;
}

double moment(const std::vector<double>& values, int order) {
  double sum = 0.0;
  for (const double value : values) sum += std::pow(value, order);
  return sum / static_cast<double>(values.size());
}

double mean_product(const std::vector<double>& a, const std::vector<double>& b,
                    std::size_t lag = 0) {
  const std::size_t count = std::min(a.size(), b.size() - lag);
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) sum += a[i] * b[i + lag];
  return sum / static_cast<double>(count);
}

double normal_cdf(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

/// Five standard errors of a mean of `most_draws` draws with the given variance.
double five_sigma(double variance) {
  return 5.0 * std::sqrt(variance / static_cast<double>(most_draws));
}

TEST(Gaussian, IsTheBoxMullerTransformOfPhilox) {
  // The definition once more, with the C library's functions and Random123 itself.
  const auto defined = [](const NoiseKey& key, NoiseChannel channel, std::uint64_t step) {
    const std::uint64_t block = step / 2;
    const auto low = [](std::uint64_t word) { return static_cast<std::uint32_t>(word); };
    const r123::Philox4x32::ctr_type words = r123::Philox4x32{}(
        {{low(block), (static_cast<std::uint32_t>(channel) + 1U) << 16U | low(block >> 32U),
          low(key.run), low(key.run >> 32U)}},
        {{low(key.seed), low(key.seed >> 32U)}});
    const auto fraction = [](std::uint32_t high, std::uint32_t below) {
      return std::ldexp(static_cast<double>((std::uint64_t{high} << 32U | below) >> 12U), -52);
    };
    const double radius = std::sqrt(-2.0 * std::log(1.0 - fraction(words[0], words[1])));
    const double angle = 2.0 * M_PI * fraction(words[2], words[3]);
    return radius * (step % 2 == 0 ? std::cos(angle) : std::sin(angle));
  };
  const NoiseKey key{0x123456789abcdef0U, 0xfedcba9876543210U};
  for (const NoiseChannel channel : {NoiseChannel::left_knee_torque, NoiseChannel::accelerometer_z,
                                     NoiseChannel::right_wheel_velocity}) {
    for (const std::uint64_t step : {0UL, 1UL, 2UL, 9999UL, 1234567890123UL}) {
      EXPECT_NEAR(standard_normal(key, channel, step), defined(key, channel, step), 1e-14);
    }
  }
  const auto values = normals({7, 3}, NoiseChannel::accelerometer_x, 200'000);
  double worst = 0.0;
  for (std::size_t step = 0; step < values.size(); ++step) {
    worst = std::max(worst,
                     std::abs(values[step] - defined({7, 3}, NoiseChannel::accelerometer_x, step)));
  }
  EXPECT_LT(worst, 1e-14);
}

TEST(Gaussian, HasTheMomentsOfTheStandardNormal) {
  const auto values = normals({1, 0}, NoiseChannel::left_wheel_torque);
  EXPECT_NEAR(moment(values, 1), 0.0, five_sigma(1.0));
  EXPECT_NEAR(moment(values, 2), 1.0, five_sigma(2.0));
  EXPECT_NEAR(moment(values, 3), 0.0, five_sigma(15.0));
  EXPECT_NEAR(moment(values, 4), 3.0, five_sigma(96.0));
  EXPECT_NEAR(moment(values, 6), 15.0, five_sigma(10170.0));
}

TEST(Gaussian, HasTheTailsOfTheStandardNormal) {
  const auto values = normals({2, 0}, NoiseChannel::right_knee_torque, 4 * most_draws);
  for (const double x : {1.0, 2.0, 3.0, 4.0}) {
    for (const double sign : {-1.0, 1.0}) {
      const double expected = normal_cdf(-x) * static_cast<double>(values.size());
      const auto count = std::count_if(values.begin(), values.end(),
                                       [&](double value) { return sign * value > x; });
      EXPECT_NEAR(static_cast<double>(count), expected, 5.0 * std::sqrt(expected)) << sign * x;
    }
  }
}

TEST(Gaussian, PassesAKolmogorovSmirnovTest) {
  for (const std::uint64_t run : {0U, 1U, 2U}) {
    auto values = normals({3, run}, NoiseChannel::accelerometer_y);
    std::sort(values.begin(), values.end());
    double distance = 0.0;
    const auto count = static_cast<double>(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double cdf = normal_cdf(values[i]);
      distance = std::max({distance, cdf - static_cast<double>(i) / count,
                           static_cast<double>(i + 1) / count - cdf});
    }
    EXPECT_LT(distance * std::sqrt(count), 1.95) << "p < 0.001";
  }
}

TEST(Gaussian, StepsAreIndependent) {
  const auto values = normals({4, 0}, NoiseChannel::left_knee_torque);
  for (const std::size_t lag : {1U, 2U, 3U, 10U, 64U, 128U}) {
    EXPECT_NEAR(mean_product(values, values, lag), 0.0, five_sigma(1.0)) << lag;
    // Squares too: the two of a pair share a radius, unless the transform is right.
    std::vector<double> squares(values.size());
    std::transform(values.begin(), values.end(), squares.begin(),
                   [](double value) { return value * value - 1.0; });
    EXPECT_NEAR(mean_product(squares, squares, lag), 0.0, five_sigma(4.0)) << lag;
  }
}

TEST(Gaussian, ChannelsRunsAndSeedsAreIndependent) {
  const auto one = normals({5, 6}, NoiseChannel::left_knee_torque);
  EXPECT_NEAR(mean_product(one, normals({5, 6}, NoiseChannel::left_wheel_torque)), 0.0,
              five_sigma(1.0));
  for (const NoiseKey& key : {NoiseKey{5, 7}, {6, 6}, {6, 5}, {5, 6ULL << 32U}}) {
    EXPECT_NEAR(mean_product(one, normals(key, NoiseChannel::left_knee_torque)), 0.0,
                five_sigma(1.0));
  }
}

TEST(Gaussian, IsAFunctionOfItsArgumentsWhateverTheOrderOfCalls) {
  const NoiseKey key{8, 9};
  std::vector<double> forward(1000);
  std::vector<double> backward(1000);
  for (std::size_t i = 0; i < 1000; ++i) {
    forward[i] = standard_normal(key, NoiseChannel::accelerometer_z, i);
  }
  for (std::size_t i = 1000; i-- > 0;) {
    standard_normal({1, 1}, NoiseChannel::left_hip_position, i);
    backward[i] = standard_normal(key, NoiseChannel::accelerometer_z, i);
  }
  EXPECT_EQ(forward, backward);
}

TEST(Gaussian, FillingGivesTheSameBitsFromAnyStepAndInAnyPieces) {
  const NoiseKey key{10, 11};
  const NoiseChannel channel = NoiseChannel::right_wheel_torque;
  for (const std::uint64_t first : {0UL, 1UL, 63UL, 128UL, 1000001UL, (1UL << 33U) - 7}) {
    for (const std::size_t count : {0U, 1U, 2U, 3U, 127U, 128U, 129U, 1000U}) {
      std::vector<double> filled(count);
      fill_standard_normal(key, channel, first, filled);
      for (std::size_t i = 0; i < count; ++i) {
        ASSERT_EQ(std::bit_cast<std::uint64_t>(filled[i]),
                  std::bit_cast<std::uint64_t>(standard_normal(key, channel, first + i)))
            << first << " + " << i << " of " << count;
      }
    }
  }
}

}  // namespace
}  // namespace touchdown::noise
