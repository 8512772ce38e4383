#include "scenarios/generation/rules.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace touchdown::scenarios {
namespace {

TEST(GreatestHeight, OfAConstantForceIsThatOfUniformAcceleration) {
  const double mass = 5.0;
  const double up = 0.5;        // m/s²
  const double duration = 0.8;  // s
  policies::TimedForce force{.time = 1.0, .duration = duration};
  force.force.z() = mass * (9.81 + up);
  const double velocity = up * duration;
  const double expected = 0.5 * up * duration * duration + velocity * velocity / (2.0 * 9.81);
  EXPECT_NEAR(greatest_height({force}, mass, 10.0), expected, 2e-3);
}

TEST(GreatestHeight, OfAForceBelowTheWeightIsZero) {
  policies::TimedForce force{.time = 1.0, .duration = 5.0, .rise = 1.0};
  force.force.z() = 49.0;
  EXPECT_EQ(greatest_height({force}, 5.0, 10.0), 0.0);
}

TEST(Rules, KeepAScenarioWithoutForces) { EXPECT_FALSE(objection_to(Scenario())); }

TEST(Rules, RejectALiftOutOfReach) {
  Scenario scenario;
  scenario.forces_for_mass = 5.0;
  policies::TimedForce force{.time = 1.0, .duration = 2.0};
  force.force.z() = 55.0;  // 1.2 m/s² for 2 s
  scenario.forces = {force};
  scenario.end.duration = 10.0;
  ASSERT_TRUE(objection_to(scenario));
  EXPECT_NE(objection_to(scenario)->find("lifts the robot by"), std::string::npos);
  scenario.forces[0].duration = 0.5;
  EXPECT_FALSE(objection_to(scenario));
  scenario.mass_scale = 1.2;  // too heavy to be lifted
  EXPECT_FALSE(objection_to(scenario));
}

TEST(Rules, RejectAJumpThatEndsBehindItsLanding) {
  Scenario scenario;
  scenario.velocity = {{.time = 1.0, .velocity = 1.2}};
  scenario.terrain.pieces = {models::Ramp{10.0, 0.1}, models::Step{0.1}, models::Flat{0.5}};
  ASSERT_TRUE(objection_to(scenario));
  scenario.terrain.pieces.back() = models::Flat{1.5};
  EXPECT_FALSE(objection_to(scenario));
}

TEST(Rules, RejectARunOfMinutes) {
  Scenario scenario;
  scenario.end.duration = 600.0;
  ASSERT_TRUE(objection_to(scenario));
  EXPECT_NE(objection_to(scenario)->find("600 s"), std::string::npos);
}

}  // namespace
}  // namespace touchdown::scenarios
