#include "estimator/force/leg_geometry.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/estimator/force/held_leg.hpp"

namespace touchdown {
namespace {

using test::gravity;
using test::holding;
using test::mirrored;

TEST(VerticalForce, ExplainsTheTorques) {
  for (const LegGeometry& leg :
       {LegGeometry(),
        LegGeometry{
            .upper_length = 0.3, .lower_length = 0.2, .upper_mass = 1.5, .wheel_mass = 0.4}}) {
    for (const double hip : {-0.2, 0.1, 0.455, 1.0}) {
      for (const double knee : {-1.5, -0.791, -0.17}) {
        for (const double force : {0.0, 26.2, 120.0}) {
          for (const double acceleration : {-gravity, 0.0, 7.0}) {
            const LegSignals held = holding(leg, hip, knee, 3.0, force, acceleration);
            EXPECT_NEAR(vertical_force(leg, held, false, acceleration), force, 1e-6);
            EXPECT_NEAR(vertical_force(leg, mirrored(held), true, acceleration), force, 1e-6);
          }
        }
      }
    }
  }
}

TEST(VerticalForce, OfAStraightLegIsUnknown) {
  LegSignals straight;
  straight.hip.torque = 1.0;
  EXPECT_FALSE(std::isfinite(vertical_force({}, straight, false, 0.0)));
}

TEST(AxleVelocity, IsTheDerivativeOfItsHeight) {
  const LegGeometry leg;
  for (const double hip : {-0.2, 0.455, 1.0}) {
    for (const double knee : {-1.5, -0.791, 0.3}) {
      LegSignals moving;
      moving.hip = {hip, 1.3, 0.0};
      moving.knee = {knee, -2.1, 0.0};
      constexpr double step = 1e-6;
      const auto height = [&](double time) {
        return test::leg_positions(leg, hip + 1.3 * time, knee - 2.1 * time).z;
      };
      const double expected = (height(step) - height(-step)) / (2.0 * step);
      EXPECT_NEAR(axle_velocity(leg, moving), expected, 1e-8);
      LegSignals right = mirrored(moving);
      EXPECT_NEAR(axle_velocity(leg, right), expected, 1e-8);
    }
  }
}

}  // namespace
}  // namespace touchdown
