// The shipped model serves the rates that it was measured at, through C++ and C alike.
#include <array>
#include <cstring>
#include <string>

#include <gtest/gtest.h>

#include "estimator/npz/load_estimator.hpp"
#include "estimator/touchdown.h"

namespace touchdown {
namespace {

const std::string shipped = std::string(TOUCHDOWN_SOURCE_DIR) + "/models/evidence_curves.npz";

/// The complaint of C about a rate, or a robot; empty if the estimator was created.
std::string complaint_of_c(double rate, const char* robot = nullptr) {
  std::array<char, 300> error{};
  const touchdown_use use{nullptr, rate, robot};
  touchdown_estimator* estimator =
      touchdown_create(shipped.c_str(), &use, error.data(), error.size());
  touchdown_destroy(estimator);
  return error.data();
}

TEST(ShippedModel, ServesTheMeasuredRatesThroughCAndCpp) {
  for (const double rate : {199.0, 200.0, 250.0, 400.0, 500.0, 600.0, 999.0, 1000.0, 1009.0}) {
    EXPECT_NO_THROW((void)load_estimator(shipped, {.sample_rate = rate})) << rate;
    EXPECT_EQ(complaint_of_c(rate), "") << rate;
  }
  for (const double rate : {100.0, 195.0, 1020.0, 2000.0}) {
    EXPECT_THROW((void)load_estimator(shipped, {.sample_rate = rate}), InputError) << rate;
    EXPECT_NE(complaint_of_c(rate).find("serves 200 to 1000 Hz"), std::string::npos) << rate;
  }
}

TEST(ShippedModel, ServesUpkieAloneThroughCAndCpp) {
  EXPECT_EQ(complaint_of_c(0.0, "upkie"), "");
  EXPECT_NO_THROW((void)load_estimator(shipped, {.robot = "upkie"}));
  for (const char* robot : {"mine", "upkie_heavy", "Upkie", "upkie "}) {
    const std::string expected =
        std::string("was fitted to the robot 'upkie', not to '") + robot + "'";
    EXPECT_NE(complaint_of_c(0.0, robot).find(expected), std::string::npos) << robot;
    try {
      (void)load_estimator(shipped, {.robot = robot});
      ADD_FAILURE() << robot;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace touchdown
