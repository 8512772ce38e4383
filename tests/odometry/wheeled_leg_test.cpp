#include "estimator/odometry/wheeled_leg.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace touchdown::odometry {
namespace {

TEST(WheeledLeg, IsWhereThePlanarGeometryPutsIt) {
  // x = L₁ sin q₁ + L₂ sin(q₁ + q₂), z = −L₁ cos q₁ − L₂ cos(q₁ + q₂); both forward positive, which
  // is minus the right leg's joints.
  for (const std::size_t side : {0U, 1U}) {
    const double sign = side == 0 ? 1.0 : -1.0;
    const LegJoints joints{{sign * 0.4, sign * -0.7, 0.0}, {}};
    const WheelMotion wheel = motion_of(upkie().leg[side], joints);
    EXPECT_NEAR(wheel.centre.x(), 0.168 * std::sin(0.4) + 0.175 * std::sin(-0.3), 1e-15);
    EXPECT_NEAR(wheel.centre.z(), -0.064 - 0.168 * std::cos(0.4) - 0.175 * std::cos(-0.3), 1e-15);
    EXPECT_NEAR(wheel.centre.y(), sign * 0.1524, 1e-15);
  }
}

TEST(WheeledLeg, HasTheVelocityOfFiniteDifferences) {
  for (const WheeledLeg& leg : upkie().leg) {
    LegJoints joints{{0.5, -0.9, 3.0}, {1.5, -2.5, 20.0}};
    constexpr double h = 1e-6;
    LegJoints before = joints, after = joints;
    for (std::size_t i = 0; i < 3; ++i) {
      before.position[i] -= h * joints.velocity[i];
      after.position[i] += h * joints.velocity[i];
    }
    const Eigen::Vector3d moved = motion_of(leg, after).centre - motion_of(leg, before).centre;
    EXPECT_LT((motion_of(leg, joints).velocity - moved / (2.0 * h)).norm(), 1e-9);
  }
}

TEST(WheeledLeg, TurnsItsWheelByAllThreeJoints) {
  const LegJoints left{{}, {1.0, 2.0, 10.0}};  // hip and knee bend forward, which is about −y
  EXPECT_DOUBLE_EQ(motion_of(upkie().leg[0], left).spin, 10.0 - 3.0);
  const LegJoints right{{}, {-1.0, -2.0, -10.0}};
  EXPECT_DOUBLE_EQ(motion_of(upkie().leg[1], right).spin, 10.0 - 3.0);
}

}  // namespace
}  // namespace touchdown::odometry
