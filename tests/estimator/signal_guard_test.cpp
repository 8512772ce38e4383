#include "estimator/signal_guard.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace touchdown {
namespace {

TEST(SignalGuard, AcceptsASteadyStream) {
  SignalGuard guard({}, 1000.0);
  for (int t = 0; t < 5000; ++t) {
    const auto verdict = guard.check(100.0 + 0.001 * t, std::sin(t));
    ASSERT_EQ(verdict.status, SignalStatus::good) << t;
    ASSERT_TRUE(verdict.acceleration_good);
    ASSERT_NEAR(verdict.elapsed, 0.001, 1e-9);
  }
}

TEST(SignalGuard, DetectsGapsForwardsAndBackwards) {
  SignalGuard guard({}, 1000.0);
  guard.check(1.0, 0.1);
  EXPECT_EQ(guard.check(1.019, 0.2).status, SignalStatus::good);
  const auto gap = guard.check(1.5, 0.3);
  EXPECT_EQ(gap.status, SignalStatus::gap);
  EXPECT_TRUE(gap.restart);
  EXPECT_TRUE(gap.acceleration_good);
  EXPECT_NEAR(gap.elapsed, 0.481, 1e-9);
  const auto back = guard.check(0.2, 0.4);
  EXPECT_EQ(back.status, SignalStatus::gap);
  EXPECT_EQ(guard.relaxed(0.99, back.elapsed), 0.5);
  EXPECT_EQ(guard.check(0.201, 0.5).status, SignalStatus::good);
  EXPECT_EQ(guard.check(0.201, 0.6).status, SignalStatus::good) << "the same time is no gap";
}

TEST(SignalGuard, RefusesWhatIsNoAcceleration) {
  SignalGuard guard({}, 1000.0);
  double time = 0.0;
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL, 2e4, 1e300}) {
    const auto verdict = guard.check(time += 0.001, bad);
    EXPECT_EQ(verdict.status, SignalStatus::invalid) << bad;
    EXPECT_FALSE(verdict.acceleration_good);
  }
  EXPECT_EQ(guard.check(time += 0.001, 300.0).status, SignalStatus::good);
  EXPECT_EQ(guard.check(std::nan(""), 0.0).status, SignalStatus::invalid);
  EXPECT_EQ(guard.check(time + 0.001, 1.0).status, SignalStatus::good);
}

TEST(SignalGuard, RefusesWhatIsNoTorque) {
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL, 1.0001e4, -2e4, 1e300, 1e308}) {
    EXPECT_FALSE(is_torque(bad)) << bad;
    LegSignals leg;
    EXPECT_TRUE(has_torques(leg));
    leg.wheel.torque = bad;
    EXPECT_FALSE(has_torques(leg));
    leg.wheel.torque = 1.0;
    leg.knee.torque = bad;
    EXPECT_FALSE(has_torques(leg));
  }
  for (const double good : {0.0, -0.0, 1e-310, -1.7, 300.0, 1e4}) EXPECT_TRUE(is_torque(good));
  SignalGuardConfig config;
  config.largest_torque = 5.0;
  EXPECT_FALSE(is_torque(6.0, config));
  config.largest_torque = 0.0;
  EXPECT_THROW(SignalGuard(config, 1000.0), InputError);
}

TEST(SignalGuard, NoticesAFrozenAccelerometerAndItsRecovery) {
  SignalGuardConfig config;
  config.frozen_after = 0.1;
  SignalGuard guard(config, 1000.0);
  int first_frozen = -1;
  for (int t = 0; t < 300; ++t) {
    const auto verdict = guard.check(0.001 * t, 0.125);
    if (verdict.status == SignalStatus::frozen && first_frozen < 0) {
      first_frozen = t;
    }
    EXPECT_EQ(verdict.acceleration_good, verdict.status == SignalStatus::good);
  }
  EXPECT_EQ(first_frozen, 100);
  EXPECT_EQ(guard.check(0.3, 0.1250001).status, SignalStatus::good);
}

TEST(SignalGuard, AllowsRepetitionIfConfigured) {
  SignalGuardConfig config;
  config.frozen_after = 0.0;
  SignalGuard guard(config, 1000.0);
  for (int t = 0; t < 5000; ++t) {
    ASSERT_EQ(guard.check(0.001 * t, 0.0).status, SignalStatus::good);
  }
}

TEST(SignalGuard, RelaxesToTheFlatPriorAtItsTimeConstant) {
  SignalGuardConfig config;
  config.relaxation = 0.2;
  const SignalGuard guard(config, 1000.0);
  EXPECT_NEAR(guard.relaxed(1.0, 0.2), 0.5 + 0.5 * std::exp(-1.0), 1e-12);
  EXPECT_NEAR(guard.relaxed(0.0, 0.2), 0.5 - 0.5 * std::exp(-1.0), 1e-12);
  EXPECT_EQ(guard.relaxed(0.5, 0.01), 0.5);
  double p = 0.9;
  for (int t = 0; t < 200; ++t) {
    p = guard.relaxed(p, 0.001);
  }
  EXPECT_NEAR(p, guard.relaxed(0.9, 0.2), 1e-12) << "many small steps are one large one";
}

TEST(SignalGuard, RefusesInvalidValues) {
  EXPECT_THROW(SignalGuard({}, 0.0), InputError);
  SignalGuardConfig config;
  config.relaxation = 0.0;
  EXPECT_THROW(SignalGuard(config, 1000.0), InputError);
  config = {};
  config.frozen_after = -1.0;
  EXPECT_THROW(SignalGuard(config, 1000.0), InputError);
}

}  // namespace
}  // namespace touchdown
