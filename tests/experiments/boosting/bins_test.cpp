#include <array>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/boosting/fit.hpp"
#include "tests/estimator/random.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::ElementsAre;

std::vector<std::uint8_t> bins_of(const FeatureBins& bins, const std::vector<float>& row) {
  std::vector<std::uint8_t> found;
  bins.append(row, found);
  return found;
}

TEST(FeatureBins, AreOneForEachOfFewValues) {
  const std::vector<float> rows = {1.0F, 5.0F, -2.0F, 5.0F, 0.0F, 5.0F, 1.0F, 5.0F};
  const FeatureBins bins(rows, 2);
  ASSERT_EQ(bins.width(), 2U);
  EXPECT_THAT(bins_of(bins, {-2.0F, 5.0F}), ElementsAre(0, 0));
  EXPECT_THAT(bins_of(bins, {0.0F, 5.0F}), ElementsAre(1, 0));
  EXPECT_THAT(bins_of(bins, {1.0F, 5.0F}), ElementsAre(2, 0));
  EXPECT_THAT(bins_of(bins, {-9.0F, -9.0F}), ElementsAre(0, 0));
  EXPECT_THAT(bins_of(bins, {0.5F, 9.0F}), ElementsAre(1, 0));
  EXPECT_EQ(bins.threshold(0, 1), 0.0F);
  EXPECT_EQ(bins.threshold(0, 2), 1.0F);
  EXPECT_EQ(bins.threshold(1, 1), std::numeric_limits<float>::max());  // a constant has one bin
}

TEST(FeatureBins, AgreeWithTheirThresholds) {
  enum class Kind { continuous, half_at_one_value, in_steps };
  for (const Kind kind : {Kind::continuous, Kind::half_at_one_value, Kind::in_steps}) {
    std::vector<float> values;
    for (const double value : test::normals(5000, 0.0, 1.0, 1)) {
      const auto single = static_cast<float>(value);
      values.push_back(kind == Kind::half_at_one_value && value < 0.0 ? 0.0F
                       : kind == Kind::in_steps ? 0.25F * std::round(4.0F * single)
                                                : single);
    }
    const FeatureBins bins(values, 1);
    std::array<std::size_t, FeatureBins::most> count{};
    for (const float value : values) {
      const std::size_t own = bins_of(bins, {value})[0];
      ++count[own];
      if (own > 0) {
        EXPECT_GE(value, bins.threshold(0, own));
      }
      EXPECT_LT(value, bins.threshold(0, own + 1));
    }
    if (kind != Kind::continuous) continue;
    for (const std::size_t in_bin : count) EXPECT_NEAR(static_cast<double>(in_bin), 19.5, 1.0);
  }
}

}  // namespace
}  // namespace touchdown::experiments
