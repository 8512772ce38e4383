// A program that includes the documented header alone can catch what it throws.
#include "odometry/filter.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace {

TEST(DocumentedHeader, BringsTheErrorsThatItThrows) {
  EXPECT_THROW((void)touchdown::odometry::ContactOdometry({.gravity = std::nan("")}),
               touchdown::InputError);
}

}  // namespace
