// A program that includes the documented header alone can catch what it throws.
#include <gtest/gtest.h>

#include "estimator/estimator.hpp"

namespace {

TEST(DocumentedHeader, BringsTheErrorsThatItThrows) {
  EXPECT_THROW((void)touchdown::FreeFall({.sample_rate = -1.0}), touchdown::InputError);
  EXPECT_THROW((void)touchdown::SignalAssembler({.sample_rate = 0.0}), touchdown::InputError);
}

}  // namespace
