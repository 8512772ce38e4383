#include "estimator/stopped_signals.hpp"

#include <bit>
#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include "estimator/contact_estimator.hpp"
#include "tests/estimator/random.hpp"

namespace touchdown {
namespace {

using Values = std::array<double, signal_count>;
constexpr std::size_t judged = 24;  // joints and IMU

Signals signals_of(double time, const Values& v) {
  Signals s;
  s.time = time;
  for (std::size_t side = 0; side < 2; ++side) {
    const double* leg = v.data() + 9 * side;
    s.leg[side] = {{leg[0], leg[1], leg[2]}, {leg[3], leg[4], leg[5]}, {leg[6], leg[7], leg[8]}};
  }
  s.linear_acceleration = {v[18], v[19], v[20]};
  s.angular_velocity = {v[21], v[22], v[23]};
  s.vertical_acceleration = v[24];
  s.ground_velocity_command = v[25];
  return s;
}

/// A robot of which everything moves: positions are 1 + sin(2 t), torques and the IMU have noise.
Values moving(double time, test::Normal& normal) {
  Values v{};
  for (std::size_t i = 0; i < 18; i += 3) {
    v[i] = 1.0 + std::sin(2.0 * time);
    v[i + 1] = 2.0 * std::cos(2.0 * time);
    v[i + 2] = 1.0 + 0.1 * normal();
  }
  for (std::size_t i = 18; i < signal_count; ++i) v[i] = 0.1 * normal();
  return v;
}

using Change = std::function<void(double time, Values& values)>;

/// When the first signal stops (s), and which; infinity if none does within four seconds.
std::pair<double, std::uint32_t> first_stop(const Change& change, double rate = 1000.0) {
  StoppedSignals guard;
  test::Normal normal(3);
  for (int k = 0; k < static_cast<int>(4.0 * rate); ++k) {
    const double time = 100.0 + k / rate;
    Values values = moving(time - 100.0, normal);
    change(time - 100.0, values);
    const std::uint32_t stopped = guard.update(signals_of(time, values));
    if (stopped != 0) return {time - 100.0, stopped};
  }
  return {std::numeric_limits<double>::infinity(), 0};
}

double rounded(double value, double step) { return step * std::round(value / step); }

TEST(StoppedSignals, AnySignalThatStopsIsFoundAfterAQuarterOfASecond) {
  for (const double rate : {100.0, 500.0, 1000.0, 4000.0}) {
    for (std::size_t i = 0; i < judged; ++i) {
      for (const bool is_zero : {false, true}) {
        double last = 0.0;
        const auto [time, stopped] = first_stop(
            [&](double t, Values& v) {
              if (t < 1.2) last = 0.5 * v[i];
              if (t >= 1.2) v[i] = is_zero ? 0.0 : last;
            },
            rate);
        EXPECT_EQ(stopped, 1U << i) << to_text(static_cast<SignalIndex>(i)) << ' ' << rate;
        EXPECT_NEAR(time, 1.47, 0.04) << to_text(static_cast<SignalIndex>(i)) << ' ' << rate;
      }
    }
  }
}

TEST(StoppedSignals, HealthySignalsThatRepeatThemselvesAreNoFaults) {
  const auto of_all = [](auto change) {
    return [change](double t, Values& v) {
      for (std::size_t i = 0; i < judged; ++i) v[i] = change(t, v[i], i);
    };
  };
  Values held{};
  const auto hold = [&](double period) {
    return [&held, period, next = 0.0](double t, Values& v) mutable {
      if (t >= next) held = v;
      if (t >= next) next = t + period - 1e-6;
      v = held;
    };
  };
  Values start{};
  const std::pair<const char*, Change> cases[] = {
      {"no fault", [](double, Values&) {}},
      {"held at 200 Hz", hold(0.005)},
      {"held at 50 Hz", hold(0.02)},
      {"held at 12 Hz", hold(0.08)},
      {"coarse", of_all([](double, double value, std::size_t) { return rounded(value, 0.05); })},
      {"torques of two values",
       [](double t, Values& v) {
         for (std::size_t i = 2; i < 18; i += 3) v[i] = t < 2.0 ? 1.0 : 0.5;
       }},
      {"a fine resolution, smooth and then at rest", of_all([](double t, double, std::size_t i) {
         const double x = t < 2.0 ? t * (2.0 - t) : 0.0;
         return i % 3 == 2 || i >= 18 ? rounded(0.1 + x, 1e-3) : 0.0;
       })},
      {"never there", of_all([](double, double, std::size_t) { return 0.0; })},
      {"not reported",
       of_all([](double t, double value, std::size_t) { return t < 1.0 ? value : std::nan(""); })},
      {"one torque not there", [](double, Values& v) { v[5] = 0.0; }},
      {"a torque, a velocity and an axis not there, but for wrong values",
       [](double t, Values& v) {
         const bool is_wrong = (t > 1.0 && t < 1.1) || (t > 2.0 && t < 2.05);
         v[5] = v[7] = v[19] = is_wrong ? 3.0 : 0.0;
       }},
      {"torques at their limit",
       [](double t, Values& v) {
         for (std::size_t i = 2; t > 1.0 && i < 18; i += 3) v[i] = i % 2 == 0 ? 1.7 : -1.7;
       }},
      {"an accelerometer at the end of its range",
       [](double t, Values& v) { v[20] = t > 1.0 ? -39.24 : v[20]; }},
      {"at rest",
       [&](double t, Values& v) {
         if (t <= 1.0) start = v;
         v = start;
         for (std::size_t i = 1; t > 1.0 && i < 18; i += 3) v[i] = 0.0;
       }},
      {"legs that stand still by quiet encoders",
       [](double t, Values& v) {
         for (std::size_t i = 0; t > 1.0 && i < 18; i += 3) v[i] = 1.0 + std::sin(2.0);
         for (std::size_t i = 1; t > 1.0 && i < 18; i += 3) v[i] = 0.0;
       }},
      {"one wrong value before a rest",
       [](double t, Values& v) {
         for (std::size_t i = 0; i < 18; i += 3) v[i] = t < 1.0 ? 1.0 + t : 2.0;
         for (std::size_t i = 1; i < 18; i += 3) v[i] = t < 1.0 ? 1.0 : 0.0;
         if (t > 1.5 && t < 1.53) v[0] = v[3] = 0.0;
       }},
      {"wheels at one speed, reported within a turn",
       [](double t, Values& v) {
         v[7] = v[16] = t > 1.0 ? 30.0 : v[7];
         v[6] = v[15] = std::remainder(30.0 * t, 6.283185307179586);
       }},
  };
  for (const auto& [name, change] : cases) {
    const auto [time, stopped] = first_stop(change);
    EXPECT_EQ(stopped, 0U) << name << ": "
                           << to_text(static_cast<SignalIndex>(std::countr_zero(stopped))) << " at "
                           << time;
  }
}

TEST(StoppedSignals, AGapOrAStepBackIsNoRepetition) {
  const auto stops = [](double jump) {
    StoppedSignals guard;
    test::Normal normal(5);
    std::uint32_t stopped = 0;
    for (int k = 0; k < 1200; ++k) {
      Values values = moving(1e-3 * k, normal);
      if (k > 800) values[5] = 0.75;  // for 0.2 s before the jump, and for 0.2 s behind it
      stopped |= guard.update(signals_of(1e-3 * k + (k > 1000 ? jump : 0.0), values));
    }
    return stopped;
  };
  EXPECT_EQ(stops(0.0), 1U << 5U);
  EXPECT_EQ(stops(0.5), 0U);
  EXPECT_EQ(stops(-0.5), 0U);
}

/// An estimator that believes in contact while the left knee has a torque.
class ByKnee final : public ContactEstimator {
 public:
  void reset() noexcept override {}

 private:
  const Belief& estimate(const Signals& signals) noexcept override {
    const bool is_usable = std::isfinite(signals.leg[0].knee.torque);
    belief_.status = is_usable ? SignalStatus::good : SignalStatus::invalid;
    has_vertical = std::isfinite(signals.vertical_acceleration);
    return belief_;
  }
  Belief belief_;

 public:
  bool has_vertical = true;
};

TEST(StoppedSignals, ABeliefNamesTheSignalUntilItMovesAgain) {
  constexpr auto knee = SignalIndex{5};
  constexpr auto acceleration = SignalIndex{19};
  for (const SignalIndex signal : {knee, acceleration}) {
    ByKnee estimator;
    test::Normal normal(7);
    for (int k = 0; k < 2000; ++k) {
      Values values = moving(1e-3 * k, normal);
      if (k >= 1000 && k < 1600) values[static_cast<std::size_t>(signal)] = 0.0;
      const Belief& belief = estimator.update(signals_of(1e-3 * k, values));
      const bool stopped = k >= 1295 && k < 1600;
      if (!stopped && k >= 1250 && k < 1625) continue;  // it compares every 21 ms
      ASSERT_EQ(belief.unusable, stopped ? signal : SignalIndex::none) << k;
      const bool is_used = !(stopped && signal == knee);
      ASSERT_EQ(belief.status, is_used ? SignalStatus::good : SignalStatus::frozen) << k;
      ASSERT_EQ(estimator.has_vertical, !(stopped && signal == acceleration)) << k;
    }
  }
}

}  // namespace
}  // namespace touchdown
