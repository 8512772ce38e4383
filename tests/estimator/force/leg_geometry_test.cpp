#include "estimator/force/leg_geometry.hpp"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/estimator/force/held_leg.hpp"

namespace touchdown {
namespace {

using test::leg_positions;
using test::mirrored;

LegSignals posed(double hip, double knee) {
  LegSignals leg;
  leg.hip.position = hip;
  leg.knee.position = knee;
  return leg;
}

TEST(FootJacobian, IsTheDerivativeOfTheFootsPosition) {
  constexpr double step = 1e-6;
  for (const LegGeometry& leg :
       {LegGeometry{}, LegGeometry{.upper_length = 0.3, .lower_length = 0.2}}) {
    for (const double hip : {-0.2, 0.455, 1.0}) {
      for (const double knee : {-1.5, -0.791, 0.3}) {
        const auto slope = [&](double along_hip, double along_knee,
                               double test::LegPositions::*of) {
          const double up = leg_positions(leg, hip + along_hip, knee + along_knee).*of;
          const double down = leg_positions(leg, hip - along_hip, knee - along_knee).*of;
          return (up - down) / (2.0 * step);
        };
        const LegSignals left = posed(hip, knee);
        for (const FootJacobian& foot :
             {foot_jacobian(leg, left, false), foot_jacobian(leg, mirrored(left), true)}) {
          EXPECT_NEAR(foot.upper_x + foot.lower_x, slope(step, 0.0, &test::LegPositions::x), 1e-8);
          EXPECT_NEAR(foot.upper_z + foot.lower_z, slope(step, 0.0, &test::LegPositions::z), 1e-8);
          EXPECT_NEAR(foot.lower_x, slope(0.0, step, &test::LegPositions::x), 1e-8);
          EXPECT_NEAR(foot.lower_z, slope(0.0, step, &test::LegPositions::z), 1e-8);
        }
      }
    }
  }
}

TEST(FootJacobian, OfAStraightLegHasNoDeterminant) {
  EXPECT_NEAR(foot_jacobian({}, posed(0.4, 0.0), false).determinant(), 0.0, 1e-15);
  EXPECT_GT(std::abs(foot_jacobian({}, posed(0.4, -0.3), false).determinant()), 1e-3);
}

}  // namespace
}  // namespace touchdown
