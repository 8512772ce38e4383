#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "estimator/evidence/filter.hpp"
#include "tests/estimator/evidence/lifted_curves.hpp"

namespace touchdown {
namespace {

constexpr double unusable = std::numeric_limits<double>::quiet_NaN();

void remove_signals(LegSignals& leg) {
  for (JointSignals* joint : {&leg.hip, &leg.knee, &leg.wheel})
    *joint = {unusable, unusable, unusable};
}

/// Changes the signals of a faulty step; `before`: the last healthy step.
using Fault = std::function<void(Signals& signals, const Signals& before)>;

const Fault left_leg_drops_out = [](Signals& s, const Signals&) { remove_signals(s.leg[0]); };
const Fault left_torque_drops_out = [](Signals& s, const Signals&) {
  s.leg[0].knee.torque = unusable;
};
const Fault both_legs_drop_out = [](Signals& s, const Signals&) {
  for (LegSignals& leg : s.leg) remove_signals(leg);
};
const Fault imu_drops_out = [](Signals& s, const Signals&) {
  s.vertical_acceleration = unusable;
  s.linear_acceleration.setConstant(unusable);
  s.angular_velocity.setConstant(unusable);
};
const Fault record_is_empty = [](Signals& s, const Signals& before) {
  imu_drops_out(s, before);
  both_legs_drop_out(s, before);
  s.time = unusable;
};
const Fault left_leg_freezes = [](Signals& s, const Signals& before) { s.leg[0] = before.leg[0]; };
const Fault gyro_freezes = [](Signals& s, const Signals& before) {
  s.angular_velocity = before.angular_velocity;
};
const Fault accelerometer_freezes = [](Signals& s, const Signals& before) {
  s.vertical_acceleration = before.vertical_acceleration;
};

constexpr std::array<bool, 2> left_leg = {true, false};
constexpr std::array<bool, 2> both_legs = {true, true};

/// Whether a wheel's belief is the undisturbed one of step k. During a takeoff or a landing the
/// undisturbed belief changes within some milliseconds, and may do so `shift` earlier or later.
bool is_as_undisturbed(const WheelBelief& belief, const std::vector<Belief>& undisturbed,
                       std::size_t k, std::size_t wheel) {
  constexpr std::size_t shift = 4;  // ms
  double least = 1.0;
  double most = 0.0;
  bool is_decided_alike = false;
  for (std::size_t i = k - shift; i <= std::min(k + shift, undisturbed.size() - 1); ++i) {
    const WheelBelief& other = undisturbed[i].wheel[wheel];
    least = std::min(least, other.p_contact);
    most = std::max(most, other.p_contact);
    is_decided_alike = is_decided_alike || other.contact == belief.contact;
  }
  // The slowest low-pass still contains a little of the fault.
  const double expected = undisturbed[k].wheel[wheel].p_contact;
  const double near = expected < 0.05 || expected > 0.95 ? 0.02 : 0.1;
  return is_decided_alike && belief.p_contact >= least - near && belief.p_contact <= most + near;
}

/// Compares an estimator on a run with faults at many times to one on the run without faults.
class Faults : public ::testing::Test {
 protected:
  static constexpr std::size_t first = 700;      // standing on both, noise is estimated
  static constexpr std::size_t recovered = 200;  // ms
  static constexpr std::size_t watched = 200;    // ms after that

  Faults() {
    run_ = test::lifted_run(3, 11);
    for (Signals& s : run_.signals) {
      // A gyro that measures the other axes, too, and a robot that rolls.
      s.angular_velocity.y() = 0.01 * std::sin(s.time);
      for (LegSignals& leg : s.leg) leg.wheel.position = s.time;
    }
    EvidenceCurves healthy(test::lifted_curves());
    for (const Signals& s : run_.signals) expected_.push_back(healthy.update(s));
  }

  /// After `delay` milliseconds of the fault the status must be `status`, and the belief of `lost`
  /// wheels must fade to one half. It may be up to `slack` (ms) longer. 200 ms after its end
  /// beliefs must be as without the fault.
  void expect_recovery(const Fault& fault, std::size_t length, SignalStatus status,
                       std::size_t delay, const std::array<bool, 2>& lost, std::size_t slack = 0) {
    EvidenceCurves healthy(test::lifted_curves());
    std::size_t next = 0;
    std::size_t faults = 0;
    for (std::size_t begin = first; begin + length + recovered + watched < run_.signals.size();
         begin += 83) {
      for (; next < begin; ++next) healthy.update(run_.signals[next]);
      EvidenceCurves estimator = healthy;
      Belief belief = expected_[begin - 1];
      const std::array<WheelBelief, 2> before = belief.wheel;
      for (std::size_t k = begin; k < begin + length; ++k) {
        Signals s = run_.signals[k];
        fault(s, run_.signals[begin - 1]);
        belief = estimator.update(s);
        for (const WheelBelief& wheel : belief.wheel) {
          ASSERT_GT(wheel.p_contact, 0.0);
          ASSERT_LT(wheel.p_contact, 1.0);
        }
        if (k >= begin + delay && k < begin + delay + slack) continue;
        ASSERT_EQ(belief.status, k < begin + delay ? SignalStatus::good : status) << k - begin;
      }
      const double faded = std::exp(-1e-3 * static_cast<double>(length - delay - slack) / 0.1);
      for (std::size_t w = 0; w < 2; ++w) {
        if (!lost[w]) continue;
        EXPECT_LE(std::abs(belief.wheel[w].p_contact - 0.5), 0.5 * faded + 1e-9);
        if (delay == 0) {
          EXPECT_EQ(belief.wheel[w].contact, before[w].contact) << "the last decision stands";
        }
      }
      const std::size_t end = begin + length;
      for (std::size_t k = end; k < end + recovered + watched; ++k) {
        belief = estimator.update(run_.signals[k]);
        if (k < end + recovered) continue;
        EXPECT_EQ(belief.status, SignalStatus::good);
        for (std::size_t w = 0; w < 2; ++w) {
          ASSERT_TRUE(is_as_undisturbed(belief.wheel[w], expected_, k, w))
              << "wheel " << w << ", fault at " << begin << ", " << k - end
              << " ms later: " << belief.wheel[w].p_contact << " instead of "
              << expected_[k].wheel[w].p_contact;
        }
      }
      ++faults;
    }
    EXPECT_GE(faults, 30U);
  }

  test::CarriedRun run_;
  std::vector<Belief> expected_;
};

TEST_F(Faults, OfASensorThatDropsOutAreOverWithin200Milliseconds) {
  expect_recovery(left_leg_drops_out, 100, SignalStatus::invalid, 0, left_leg);
  expect_recovery(left_torque_drops_out, 100, SignalStatus::invalid, 0, left_leg);
  expect_recovery(both_legs_drop_out, 100, SignalStatus::invalid, 0, both_legs);
  expect_recovery(imu_drops_out, 100, SignalStatus::invalid, 0, both_legs);
  expect_recovery(record_is_empty, 100, SignalStatus::invalid, 0, both_legs);
}

TEST_F(Faults, OfASensorThatFreezesAreOverWithin200Milliseconds) {
  expect_recovery(left_leg_freezes, 700, SignalStatus::frozen, 249, left_leg, 250);
  expect_recovery(gyro_freezes, 700, SignalStatus::frozen, 249, both_legs, 250);
  expect_recovery(accelerometer_freezes, 700, SignalStatus::frozen, 499, both_legs);
}

/// A gap counts as a gap even if it ends while the accelerometer is missing.
TEST_F(Faults, OfRecordsThatAreMissingAreOverWithin200Milliseconds) {
  EvidenceCurves healthy(test::lifted_curves());
  std::size_t next = 0;
  for (std::size_t begin = first; begin + 500 < run_.signals.size(); begin += 83) {
    for (; next < begin; ++next) healthy.update(run_.signals[next]);
    EvidenceCurves estimator = healthy;
    Belief belief;
    for (std::size_t k = begin + 100; k < begin + 500; ++k) {
      Signals s = run_.signals[k];
      if (k < begin + 105) s.vertical_acceleration = unusable;
      belief = estimator.update(s);
      if (k < begin + 100 + recovered) continue;
      for (std::size_t w = 0; w < 2; ++w) {
        ASSERT_TRUE(is_as_undisturbed(belief.wheel[w], expected_, k, w)) << begin << ' ' << k;
      }
    }
  }
}

TEST_F(Faults, DoNotIncludeHeldSamplesOrAMissingGyro) {
  EvidenceCurves estimator(test::lifted_curves());
  Signals held;
  for (std::size_t k = 0; k < run_.signals.size(); ++k) {
    if (k % 20 == 0) held = run_.signals[k];
    held.time = run_.signals[k].time;
    held.angular_velocity.setZero();  // a robot without a gyro
    ASSERT_EQ(estimator.update(held).status, SignalStatus::good) << k;
  }
}

TEST_F(Faults, DoNotIncludeASingleServoAtRest) {
  EvidenceCurves estimator(test::lifted_curves());
  for (Signals s : run_.signals) {
    for (LegSignals& leg : s.leg) leg.hip = {0.455, 0.0, 1.0};
    ASSERT_EQ(estimator.update(s).status, SignalStatus::good);
  }
}

TEST_F(Faults, DoNotIncludeAClippedBlow) {
  constexpr double blow = 80.0;                     // m/s²
  constexpr double range = 58.86;                   // m/s²: 6 g
  for (const std::size_t begin : {1250U, 2950U}) {  // landings
    EvidenceCurves whole(test::lifted_curves());
    EvidenceCurves cut_off(test::lifted_curves());
    std::vector<Belief> expected;
    std::vector<Belief> found;
    for (std::size_t k = 0; k < begin + 400; ++k) {
      Signals s = run_.signals[k];
      if (k >= begin && k < begin + 8) s.vertical_acceleration += blow;
      expected.push_back(whole.update(s));
      s.vertical_acceleration = std::min(s.vertical_acceleration, range);
      found.push_back(cut_off.update(s));
    }
    std::array<int, 2> delay = {};  // ms
    for (std::size_t k = 0; k < found.size(); ++k) {
      ASSERT_EQ(found[k].status, SignalStatus::good);
      for (std::size_t w = 0; w < 2; ++w) {
        if (found[k].wheel[w].contact != expected[k].wheel[w].contact) ++delay[w];
        if (k >= begin + recovered) {
          ASSERT_TRUE(is_as_undisturbed(found[k].wheel[w], expected, k, w)) << k;
        }
      }
    }
    for (const int steps : delay) EXPECT_LE(steps, 3) << begin;
  }
}

}  // namespace
}  // namespace touchdown
