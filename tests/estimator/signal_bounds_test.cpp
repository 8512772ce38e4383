#include "estimator/signal_bounds.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "estimator/free_fall.hpp"
#include "estimator/upkie_observer.hpp"

namespace touchdown {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

TEST(SignalCheck, NamesEverySignal) {
  const SignalCheck check;
  Signals signals;
  EXPECT_EQ(check.first_unusable(signals), SignalIndex::none);
  signals.ground_velocity_command = -inf;
  EXPECT_EQ(to_text(check.first_unusable(signals)), "ground velocity command");
  signals.vertical_acceleration = 1e5;
  EXPECT_EQ(to_text(check.first_unusable(signals)), "vertical acceleration");
  signals.angular_velocity.y() = 1e39;
  EXPECT_EQ(to_text(check.first_unusable(signals)), "angular velocity y");
  signals.linear_acceleration.z() = std::nan("");
  EXPECT_EQ(to_text(check.first_unusable(signals)), "acceleration z");
  signals.leg[1].wheel.velocity = 1e308;
  EXPECT_EQ(to_text(check.first_unusable(signals)), "right wheel velocity");
  signals.leg[1].hip.torque = -1e5;
  EXPECT_EQ(to_text(check.first_unusable(signals)), "right hip torque");
  signals.leg[0].knee.position = 1e308;
  EXPECT_EQ(to_text(check.first_unusable(signals)), "left knee position");
  EXPECT_EQ(to_text(SignalIndex::none), "");
  EXPECT_EQ(to_text(static_cast<SignalIndex>(26)), "");
}

TEST(SignalCheck, TakesTheBoundItselfAndReplacesWhatIsBeyond) {
  const SignalBounds bounds{.velocity = 20.0};
  const SignalCheck check(bounds);
  Signals signals;
  signals.time = 7.0;
  signals.leg[0].hip = {1e3, -20.0, 1e4};
  signals.leg[1].wheel = {-1e9, 20.0, -1e4};
  EXPECT_EQ(check.first_unusable(signals), SignalIndex::none);
  signals.leg[1].knee.velocity = std::nextafter(20.0, inf);
  signals.vertical_acceleration = -5e-324;
  EXPECT_EQ(to_text(check.first_unusable(signals)), "right knee velocity");
  const Signals usable = check.without_unusable(signals);
  EXPECT_TRUE(std::isnan(usable.leg[1].knee.velocity));
  EXPECT_EQ(usable.time, 7.0);
  EXPECT_EQ(usable.leg[1].wheel.position, -1e9);
  EXPECT_EQ(usable.leg[0].hip.torque, 1e4);
  EXPECT_EQ(usable.vertical_acceleration, -5e-324);
}

TEST(SignalBounds, MustBePositive) {
  for (const double bound : {0.0, -1.0, inf, std::nan("")}) {
    EXPECT_THROW(SignalCheck({.leg_position = bound}), InputError);
    EXPECT_THROW(FreeFall().limit_signals({.acceleration = bound}), InputError);
  }
}

/// Reports what a broken recurrence would: NaN from the third step on.
class Broken : public ContactEstimator {
 public:
  void reset() noexcept override {
    belief_ = {};
    steps_ = 0;
  }

 private:
  const Belief& estimate(const Signals& /*signals*/) noexcept override {
    const double p = ++steps_ < 3 ? 0.25 : std::nan("");
    belief_.wheel.fill({p, false});
    multiply_wheels(belief_);
    return belief_;
  }

  Belief belief_;
  int steps_ = 0;
};

TEST(ContactEstimator, StartsAnewWhenItsBeliefIsNoProbability) {
  Broken estimator;
  for (const double expected : {0.25, 0.25, 0.5, 0.25, 0.25, 0.5}) {
    const Belief& belief = estimator.update({});
    EXPECT_EQ(belief.wheel[0].p_contact, expected);
    EXPECT_EQ(belief.status, expected == 0.5 ? SignalStatus::invalid : SignalStatus::good);
  }
}

TEST(ContactEstimator, KeepsItsStatusIfItDoesNotUseTheSignal) {
  FreeFall estimator;
  Signals signals;
  signals.leg[0].hip.position = 1e308;
  const Belief& belief = estimator.update(signals);
  EXPECT_EQ(belief.status, SignalStatus::good);
  EXPECT_EQ(to_text(belief.unusable), "left hip position");
}

TEST(WheelContactObserver, SkipsVelocitiesBeyondTheBoundInPoliciesToo) {
  WheelContactObserver observer;
  WheelContactObserver twin;
  for (int k = 0; k < 2000; ++k) {
    const double velocity = 0.02 * std::sin(0.05 * k);
    twin.update(0.3, velocity, 1e-3);
    observer.update(0.3, k == 500 ? 1e308 : k == 501 ? -1e5 : velocity, 1e-3);
    if (k > 1500) {
      EXPECT_EQ(observer.contact(), twin.contact());
    }
  }
}

}  // namespace
}  // namespace touchdown
