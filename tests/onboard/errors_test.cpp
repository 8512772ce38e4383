// A program that includes the documented header alone can catch what it throws.
#include <string>

#include <gtest/gtest.h>

#include "estimator/npz/load_estimator.hpp"

namespace {

TEST(DocumentedHeader, BringsTheErrorsThatItThrows) {
  try {
    (void)touchdown::load_estimator("/nonexistent/model.npz");
    FAIL();
  } catch (const touchdown::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("model.npz"), std::string::npos);
  }
}

}  // namespace
