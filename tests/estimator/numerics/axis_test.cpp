#include "estimator/numerics/axis.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "core/error.hpp"

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

}  // namespace
}  // namespace touchdown
