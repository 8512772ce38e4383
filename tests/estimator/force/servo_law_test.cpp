#include "estimator/force/servo_law.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace touchdown {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(ServoTorque, IsTheLawOfTheServo) {
  // 40 (0.5 − 0.4) + 2 (0.1 − 0.3) + 0.25
  const JointSignals joint = {0.4, 0.3, 99.0};
  EXPECT_NEAR(servo_torque(joint, {0.5, 0.1, 0.25, 40.0, 2.0}, {}), 3.85, 1e-12);
  EXPECT_NEAR(servo_torque(joint, {0.5, 0.1, 0.25, 40.0, 0.0}, {}), 4.25, 1e-12);
}

TEST(ServoTorque, IsUnknownWithoutGainOrTarget) {
  const JointSignals joint = {0.4, 0.3, 1.0};
  const JointTarget target = {0.5, 0.1, 0.25, 40.0, 2.0};
  ASSERT_TRUE(std::isfinite(servo_torque(joint, target, {})));
  for (double JointTarget::*member :
       {&JointTarget::position, &JointTarget::velocity, &JointTarget::feedforward_torque,
        &JointTarget::kp, &JointTarget::kd}) {
    for (const double bad : {nan, HUGE_VAL, -HUGE_VAL, 1e300, -1e300}) {
      JointTarget other = target;
      other.*member = bad;
      EXPECT_TRUE(std::isnan(servo_torque(joint, other, {}))) << bad;
    }
  }
  for (const double kp : {0.0, -0.0, -1.0}) {
    JointTarget other = target;
    other.kp = kp;
    EXPECT_TRUE(std::isnan(servo_torque(joint, other, {}))) << kp;
  }
  for (const double bad : {nan, HUGE_VAL, 1e300}) {
    EXPECT_TRUE(std::isnan(servo_torque({bad, 0.3, 1.0}, target, {})));
    EXPECT_TRUE(std::isnan(servo_torque({0.4, bad, 1.0}, target, {})));
  }
  EXPECT_TRUE(std::isnan(servo_torque(joint, {}, {})));
}

}  // namespace
}  // namespace touchdown
