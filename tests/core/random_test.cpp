#include "core/random.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace touchdown {
namespace {

TEST(Random, PhiloxGivesThePublishedAnswers) {
  // Known answers of philox4x32-10 from the authors' test vectors.
  using Words = std::array<std::uint32_t, 4>;
  EXPECT_EQ(philox(0, 0, 0), (Words{0x6627e8d5U, 0xe169c58dU, 0xbc57ac4cU, 0x9b00dbd8U}));
  const std::uint64_t ones = ~std::uint64_t{0};
  EXPECT_EQ(philox(ones, ones, ones), (Words{0x408f276dU, 0x41c83b0eU, 0xa20bc7c6U, 0x6d5451fdU}));
  EXPECT_EQ(philox(0x299f31d0a4093822U, 0x0370734413198a2eU, 0x85a308d3243f6a88U),
            (Words{0xd16cfe09U, 0x94fdccebU, 0x5001e420U, 0x24126ea1U}));
}

TEST(Random, UniformsFillTheOpenInterval) {
  std::vector<double> values;
  double sum = 0.0;
  for (std::uint64_t i = 0; i < 100'000; ++i) {
    values.push_back(uniform01(1, 2, i));
    sum += values.back();
  }
  EXPECT_GT(*std::min_element(values.begin(), values.end()), 0.0);
  EXPECT_LT(*std::max_element(values.begin(), values.end()), 1.0);
  EXPECT_NEAR(sum / 1e5, 0.5, 5.0 * std::sqrt(1.0 / 12.0 / 1e5));
  std::sort(values.begin(), values.end());
  double distance = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    distance = std::max(distance, std::abs(values[i] - (static_cast<double>(i) + 0.5) / 1e5));
  }
  EXPECT_LT(distance * std::sqrt(1e5), 1.95) << "Kolmogorov and Smirnov, p < 0.001";
}

}  // namespace
}  // namespace touchdown
