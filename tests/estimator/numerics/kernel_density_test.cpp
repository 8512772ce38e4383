#include "estimator/numerics/kernel_density.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "tests/estimator/random.hpp"

namespace touchdown {
namespace {

using test::normals;

double gaussian(double x, double deviation) {
  const double u = x / deviation;
  return std::exp(-0.5 * u * u) / (deviation * std::sqrt(2.0 * std::numbers::pi));
}

TEST(KernelDensity, EqualsADirectDoubleSum) {
  const std::vector<double> x = normals(1000, 1.0, 0.4, 1);
  const std::vector<double> y = normals(1000, -0.2, 0.05, 2);
  const Axis x_axis{-0.5, 3.0, 37};
  const Axis y_axis{-0.6, 0.3, 23};
  const double hx = 0.03;
  const double hy = 0.002;
  const std::vector<double> grid = kernel_density(x, y, hx, hy, x_axis, y_axis);
  ASSERT_EQ(grid.size(), 37u * 23u);
  const double maximum = *std::max_element(grid.begin(), grid.end());
  for (int i = 0; i < x_axis.count; ++i) {
    for (int j = 0; j < y_axis.count; ++j) {
      double expected = 0.0;
      for (std::size_t k = 0; k < x.size(); ++k) {
        expected += gaussian(x_axis[i] - x[k], hx) * gaussian(y_axis[j] - y[k], hy);
      }
      expected /= static_cast<double>(x.size());
      const double value = grid[static_cast<std::size_t>(i * y_axis.count + j)];
      EXPECT_NEAR(value, expected, 1e-12 * maximum);
      // Also far out in the tails, where only ratios matter.
      if (expected > 1e-280) {
        EXPECT_NEAR(value / expected, 1.0, 1e-10) << x_axis[i] << " " << y_axis[j];
      }
    }
  }
}

TEST(KernelDensity, OfSeveralWidthsEqualsEachAlone) {
  // More than one block of samples, the last one not full.
  const std::vector<double> x = normals(700, 0.2, 1.0, 3);
  const std::vector<double> y = normals(700, -0.4, 0.3, 4);
  const std::array<KernelAxis, 2> x_axes = {{{0.3, {-3.0, 3.0, 7}}, {0.9, {-4.0, 5.0, 4}}}};
  const std::array<KernelAxis, 3> y_axes = {
      {{0.1, {-2.0, 1.0, 5}}, {0.2, {-2.0, 1.0, 11}}, {1.5, {-6.0, 6.0, 3}}}};
  const auto densities = kernel_densities(x, y, x_axes, y_axes);
  ASSERT_EQ(densities.size(), 6U);
  for (std::size_t i = 0; i < x_axes.size(); ++i) {
    for (std::size_t j = 0; j < y_axes.size(); ++j) {
      EXPECT_EQ(densities[i * y_axes.size() + j],
                kernel_density(x, y, x_axes[i].bandwidth, y_axes[j].bandwidth, x_axes[i].axis,
                               y_axes[j].axis));
    }
  }
}

TEST(KernelDensity, IntegratesToOne) {
  const std::vector<double> x = normals(700, 0.0, 1.0, 3);
  const Axis axis{-8.0, 8.0, 321};
  const std::vector<double> grid = kernel_density(x, x, 0.2, 0.3, axis, axis);
  double sum = 0.0;
  for (const double value : grid) {
    sum += value;
  }
  EXPECT_NEAR(sum * axis.step() * axis.step(), 1.0, 1e-9);
}

TEST(KernelDensity, FollowsScottsRule) {
  const std::vector<double> x{1.0, 2.0, 3.0, 4.0};
  const double deviation = std::sqrt(5.0 / 3.0);
  EXPECT_DOUBLE_EQ(scott_bandwidth(x, 2), std::pow(4.0, -1.0 / 6.0) * deviation);
  EXPECT_DOUBLE_EQ(scott_bandwidth(x, 1), std::pow(4.0, -1.0 / 5.0) * deviation);
  EXPECT_DOUBLE_EQ(scott_bandwidth(x, 2, 5.0), 5.0);
}

TEST(KernelDensity, RefusesInvalidSamples) {
  const Axis axis{0.0, 1.0, 3};
  const std::vector<double> none;
  const std::vector<double> one{0.5};
  const std::vector<double> constant{0.5, 0.5, 0.5};
  const std::vector<double> bad{0.5, std::nan(""), 0.1};
  const std::vector<double> good{0.5, 0.2, 0.1};
  EXPECT_THROW(scott_bandwidth(none, 2), InputError);
  EXPECT_THROW(scott_bandwidth(one, 2), InputError);
  EXPECT_THROW(scott_bandwidth(constant, 2), InputError);
  EXPECT_DOUBLE_EQ(scott_bandwidth(constant, 2, 0.1), 0.1);
  EXPECT_THROW(scott_bandwidth(bad, 2), InputError);
  EXPECT_THROW(kernel_density(none, 0.1, axis), InputError);
  EXPECT_THROW(kernel_density(bad, 0.1, axis), InputError);
  EXPECT_THROW(kernel_density(none, none, 0.1, 0.1, axis, axis), InputError);
  EXPECT_THROW(kernel_density(good, one, 0.1, 0.1, axis, axis), InputError);
  EXPECT_THROW(kernel_density(good, bad, 0.1, 0.1, axis, axis), InputError);
  EXPECT_THROW(kernel_density(good, good, 0.0, 0.1, axis, axis), InputError);
  EXPECT_THROW(kernel_density(good, good, 0.1, std::nan(""), axis, axis), InputError);
  EXPECT_THROW(kernel_density(good, good, 0.1, 0.1, Axis{1.0, 0.0, 3}, axis), InputError);
  EXPECT_THROW(kernel_density(good, good, 0.1, 0.1, Axis{0.0, 1.0, 1}, axis), InputError);
}

TEST(KernelDensity, LeavesTheFloatingPointModeAlone) {
  const std::vector<double> good{0.5, 0.2, 0.1};
  kernel_density(good, good, 1e-3, 1e-3, Axis{0.0, 1.0, 9}, Axis{0.0, 1.0, 9});
  volatile double small = std::numeric_limits<double>::min();
  EXPECT_GT(small / 2.0, 0.0);
}

}  // namespace
}  // namespace touchdown
