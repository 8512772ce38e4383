// A program that includes the documented header alone can catch what it throws.
#include <cmath>

#include <gtest/gtest.h>

#include "estimator/odometry/filter.hpp"

namespace {

TEST(DocumentedHeader, BringsTheErrorsThatItThrows) {
  EXPECT_THROW((void)touchdown::odometry::ContactOdometry({.gravity = std::nan("")}),
               touchdown::InputError);
}

}  // namespace
