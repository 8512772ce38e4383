#include "estimator/upkie_observer.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace touchdown {
namespace {

constexpr double dt = 0.001;

/// Runs a wheel of the given inertia under a sinusoidal torque. Returns the last decision.
bool drive(WheelContactObserver& observer, double inertia, double torque_amplitude,
           double seconds) {
  double velocity = 0.0;
  for (int t = 0; t * dt < seconds; ++t) {
    const double torque = torque_amplitude * std::sin(2.0 * std::numbers::pi * 2.0 * t * dt);
    velocity += torque / inertia * dt;
    observer.update(torque, velocity, dt);
  }
  return observer.contact();
}

TEST(WheelContactObserver, MeasuresTheApparentInertia) {
  WheelContactObserver observer;
  drive(observer, 0.007, 0.3, 2.0);
  EXPECT_NEAR(observer.inertia(), 0.007, 1e-4);
}

TEST(WheelContactObserver, LetsGoBelowTheLiftoffInertiaAndReturnsAboveTheTouchdownInertia) {
  WheelContactObserver observer;
  EXPECT_TRUE(observer.contact());
  EXPECT_TRUE(drive(observer, 0.0067, 0.3, 2.0)) << "half the robot on one wheel";
  EXPECT_FALSE(drive(observer, 1.7e-4, 0.05, 2.0)) << "the wheel alone";
  EXPECT_FALSE(drive(observer, 0.002, 0.3, 2.0)) << "between both thresholds: unchanged";
  EXPECT_TRUE(drive(observer, 0.0067, 0.3, 2.0));
  EXPECT_TRUE(drive(observer, 0.002, 0.3, 2.0)) << "between both thresholds: unchanged";
}

TEST(WheelContactObserver, TouchesDownOnlyUnderAccelerationAndTorque) {
  WheelContactConfig config;
  config.initially_in_contact = false;
  WheelContactObserver slow(config);
  EXPECT_FALSE(drive(slow, 0.02, 0.03, 3.0)) << "0.03/0.02 = 1.5 rad/s² at most";
  config.minimum_touchdown_torque = 1.0;
  WheelContactObserver weak(config);
  EXPECT_FALSE(drive(weak, 0.0067, 0.3, 3.0));
}

TEST(WheelContactObserver, KeepsItsDecisionForAWheelAtRest) {
  for (const bool initially : {true, false}) {
    WheelContactConfig config;
    config.initially_in_contact = initially;
    WheelContactObserver observer(config);
    for (int t = 0; t < 1000; ++t) {
      observer.update(0.0, 0.0, dt);
    }
    EXPECT_EQ(observer.contact(), initially);
  }
}

TEST(WheelContactObserver, SkipsValuesThatAreNotFinite) {
  WheelContactObserver observer;
  drive(observer, 0.0067, 0.3, 2.0);
  const double inertia = observer.inertia();
  observer.update(std::nan(""), 0.0, dt);
  observer.update(0.0, HUGE_VAL, dt);
  observer.update(0.0, 0.0, std::nan(""));
  observer.update(0.0, 0.0, 0.0);
  EXPECT_EQ(observer.inertia(), inertia);
  observer.reset();
  EXPECT_EQ(observer.inertia(), 0.0);
}

TEST(UpkieObserver, DetectsTheFloorThroughItsLegsToo) {
  UpkieObserverConfig config;
  config.wheel.initially_in_contact = false;
  UpkieObserver observer(config);
  Signals s;
  s.leg[0].knee.torque = 6.0;
  s.leg[1].knee.torque = -6.0;
  for (int t = 0; t < 200; ++t) {
    observer.update(s);
  }
  EXPECT_NEAR(observer.upper_leg_torque(), std::sqrt(72.0), 1e-6);
  EXPECT_EQ(observer.belief().p_any_wheel, 0.0);
  s.leg[0].hip.torque = 6.0;
  for (int t = 0; t < 200; ++t) {
    observer.update(s);
  }
  EXPECT_EQ(observer.belief().p_any_wheel, 1.0);
  EXPECT_EQ(observer.belief().p_both_wheels, 0.0);
  EXPECT_FALSE(observer.belief().wheel[0].contact);
}

TEST(UpkieObserver, KeepsItsDecisionThroughInvalidInput) {
  UpkieObserver observer;
  Signals s;
  s.leg[0].wheel.torque = std::nan("");
  s.leg[1].knee.torque = std::nan("");
  EXPECT_EQ(observer.update(s).status, SignalStatus::invalid);
  EXPECT_EQ(observer.belief().wheel[0].p_contact, 1.0);
  EXPECT_EQ(observer.update(Signals{}).status, SignalStatus::good);
  for (JointSignals LegSignals::*joint :
       {&LegSignals::hip, &LegSignals::knee, &LegSignals::wheel}) {
    Signals huge;
    (huge.leg[1].*joint).torque = 1e308;
    EXPECT_EQ(observer.update(huge).status, SignalStatus::invalid);
  }
  EXPECT_EQ(observer.upper_leg_torque(), 0.0);
  EXPECT_TRUE(std::isfinite(observer.upper_leg_torque()));
}

}  // namespace
}  // namespace touchdown
