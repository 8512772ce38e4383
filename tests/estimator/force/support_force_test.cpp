#include "estimator/force/support_force.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "tests/estimator/force/held_leg.hpp"

namespace touchdown {
namespace {

using test::holding;
using test::mirrored;

/// Steps of one millisecond of a crouching robot with these loads on its wheels.
class Standing {
 public:
  const Belief& carry(double left, double right, int steps, double acceleration = 0.0) {
    for (int i = 0; i < steps; ++i) {
      signals_.time += 0.001;
      signals_.vertical_acceleration = acceleration + 1e-9 * static_cast<double>(i % 2);
      signals_.leg[0] = holding({}, 0.455, -0.791, 0.0, left, acceleration);
      signals_.leg[1] = mirrored(holding({}, 0.455, -0.791, 0.0, right, acceleration));
      estimator_.update(signals_);
    }
    return update();
  }
  /// One step with the present signals.
  const Belief& update() {
    signals_.time += 0.001;
    signals_.vertical_acceleration += 1e-9;
    return belief_ = estimator_.update(signals_);
  }
  Signals& signals() { return signals_; }
  const SupportForce& estimator() const { return estimator_; }

 private:
  SupportForce estimator_;
  Signals signals_;
  Belief belief_;
};

TEST(SupportForce, DistinguishesTheWheels) {
  Standing robot;
  const Belief& both = robot.carry(26.0, 26.0, 200);
  EXPECT_TRUE(both.wheel[0].contact && both.wheel[1].contact);
  EXPECT_GT(both.p_both_wheels, 0.99);
  const Belief& left_alone = robot.carry(52.0, 0.0, 100);
  EXPECT_TRUE(left_alone.wheel[0].contact);
  EXPECT_FALSE(left_alone.wheel[1].contact);
  EXPECT_LT(left_alone.wheel[1].p_contact, 0.01);
  EXPECT_NEAR(robot.estimator().force(Side::left), 52.0, 0.1);
  EXPECT_GT(left_alone.p_any_wheel, 0.99);
}

TEST(SupportForce, DetectsALiftWithoutAFall) {
  Standing robot;
  robot.carry(26.0, 26.0, 200);
  EXPECT_LT(robot.carry(0.0, 0.0, 100, 0.5).p_any_wheel, 0.02);
}

TEST(SupportForce, KeepsContactOnAYieldingLeg) {
  // The torso falls at 6 m/s² while the wheels still carry a third of it.
  Standing robot;
  robot.carry(26.0, 26.0, 200);
  EXPECT_TRUE(robot.carry(13.0, 13.0, 200, -6.0).wheel[0].contact);
}

TEST(SupportForce, HasHysteresis) {
  Standing robot;
  robot.carry(26.0, 26.0, 100);
  EXPECT_TRUE(robot.carry(8.0, 8.0, 200).wheel[0].contact);  // above 6 N it stays
  EXPECT_FALSE(robot.carry(5.0, 5.0, 200).wheel[0].contact);
  EXPECT_FALSE(robot.carry(10.0, 10.0, 200).wheel[0].contact);  // below 12 N it stays away
  EXPECT_TRUE(robot.carry(13.0, 13.0, 200).wheel[0].contact);
}

TEST(SupportForce, RelaxesForALegWithoutSignals) {
  Standing robot;
  robot.carry(26.0, 26.0, 200);
  for (const double bad : {std::nan(""), HUGE_VAL, 1e9}) {
    robot.signals().leg[1].hip.torque = bad;
    for (int i = 0; i < 1000; ++i) robot.update();
    const Belief& belief = robot.update();
    EXPECT_EQ(belief.status, SignalStatus::invalid);
    EXPECT_GT(belief.wheel[0].p_contact, 0.99);  // the other leg continues
    EXPECT_NEAR(belief.wheel[1].p_contact, 0.5, 0.01);
    EXPECT_TRUE(belief.wheel[1].contact);  // the last decision
    EXPECT_EQ(robot.carry(26.0, 26.0, 100).status, SignalStatus::good);
  }
  robot.signals().vertical_acceleration = std::nan("");
  EXPECT_EQ(robot.update().status, SignalStatus::invalid);
}

TEST(SupportForce, StartsAndResetsToTheFlatPrior) {
  Standing robot;
  EXPECT_EQ(SupportForce().update(Signals()).wheel[0].p_contact,
            0.5);  // straight legs give no evidence
  robot.carry(0.0, 0.0, 100);
  SupportForce estimator;
  estimator.update(robot.signals());
  estimator.reset();
  EXPECT_EQ(estimator.force(Side::left), 0.0);
}

TEST(SupportForce, RefusesInvalidValues) {
  const auto refused = [](const SupportForceConfig& config) {
    EXPECT_THROW(SupportForce{config}, InputError);
  };
  refused({.sample_rate = 0.0});
  refused({.low_pass = -1.0});
  refused({.contact = 5.0, .release = 6.0});
  refused({.width = 0.0});
  refused({.geometry = {.lower_length = 0.0}});
  refused({.low_pass = std::numeric_limits<double>::quiet_NaN()});
}

}  // namespace
}  // namespace touchdown
