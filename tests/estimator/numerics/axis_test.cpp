#include "estimator/numerics/axis.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "tests/complaint.hpp"

namespace touchdown {
namespace {

TEST(Axis, PlacesValuesBetweenTheirNeighbours) {
  const AxisLookup lookup(Axis{-1.0, 3.0, 5});
  EXPECT_EQ(lookup.place(0.25).index, 1);
  EXPECT_DOUBLE_EQ(lookup.place(0.25).weight, 0.25);
}

TEST(Axis, ClampsToItsEnds) {
  const AxisLookup lookup(Axis{-1.0, 3.0, 5});
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double below : {-1.0, -7.0, -1e300, -infinity, std::nan("")}) {
    EXPECT_EQ(lookup.place(below).index, 0) << below;
    EXPECT_EQ(lookup.place(below).weight, 0.0) << below;
  }
  for (const double above : {3.0, 7.0, 1e300, infinity}) {
    EXPECT_EQ(lookup.place(above).index, 3) << above;
    EXPECT_EQ(lookup.place(above).weight, 1.0) << above;
  }
}

TEST(Axis, IsReadFromRegularPointsOnly) {
  EXPECT_EQ(axis_from_points(std::vector<double>{0.0, 0.5, 1.0}), (Axis{0.0, 1.0, 3}));
  EXPECT_THROW(axis_from_points(std::vector<double>{}), InputError);
  EXPECT_THROW(axis_from_points(std::vector<double>{1.0}), InputError);
  EXPECT_THROW(axis_from_points(std::vector<double>{1.0, 0.0}), InputError);
  EXPECT_THROW(axis_from_points(std::vector<double>{0.0, 0.4, 1.0}), InputError);
  EXPECT_THROW(axis_from_points(std::vector<double>{0.0, std::nan(""), 1.0}), InputError);
}

TEST(Axis, OfRoundedPointsIsAccepted) {
  std::vector<double> single, six_decimals;
  for (int i = 0; i <= 700; ++i) {
    const double point = 0.1 + 1.4 * i / 700.0;
    single.push_back(static_cast<float>(point));
    six_decimals.push_back(std::round(1e6 * point) / 1e6);
  }
  for (const auto& points : {single, six_decimals}) {
    const Axis axis = axis_from_points(points);
    EXPECT_EQ(axis.count, 701);
    EXPECT_NEAR(axis.step(), 0.002, 1e-8);
  }
}

TEST(Axis, RefusesIrregularPointsWithAllDigits) {
  EXPECT_EQ(complaint_of([] {
              axis_from_points(std::vector<double>{0.0, 1e-7, 2.5e-7});
            }),
            "a grid axis must be equally spaced; point 1 is 1e-07, expected 1.25e-07");
}

}  // namespace
}  // namespace touchdown
