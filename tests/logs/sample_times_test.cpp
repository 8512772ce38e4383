#include "logs/sample_times.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace touchdown::logs {
namespace {

constexpr std::size_t count = 200;

/// Times of samples at equal distances (s), changed by `stamp`.
template <typename Stamp>
std::vector<double> sampled(double rate, const Stamp& stamp) {
  std::vector<double> times;
  for (std::size_t k = 0; k < count; ++k) {
    times.push_back(stamp(static_cast<double>(k) / rate, k));
  }
  return times;
}

double rate_of(const std::vector<double>& times) { return 1.0 / typical_step(times).value(); }

/// Relative error of a rate.
MATCHER_P(IsRate, rate, "") { return std::abs(arg / rate - 1.0) < 0.004; }

TEST(TypicalStep, IsTheRateOfStampsThatAreRoundedToATick) {
  for (const double rate : {200.0, 250.0, 300.0, 400.0, 600.0, 700.0, 800.0, 850.0, 950.0}) {
    for (const double tick : {1e-3, 1e-4}) {
      EXPECT_THAT(rate_of(sampled(
                      rate, [&](double t, std::size_t) { return tick * std::round(t / tick); })),
                  IsRate(rate))
          << rate << " Hz in " << tick;
    }
  }
  const auto coarse = [](double t, std::size_t) { return 0.004 * std::floor(t / 0.004); };
  EXPECT_NEAR(rate_of(sampled(1000.0, coarse)), 1000.0, 20.0);
}

TEST(TypicalStep, IsTheRateOfJitteredStamps) {
  for (const double jitter : {1e-6, 2e-5, 2e-4}) {
    for (const unsigned seed : {1U, 2U, 3U}) {
      std::mt19937 generator(seed);
      std::normal_distribution<double> draw(0.0, jitter);
      EXPECT_THAT(
          rate_of(sampled(800.0, [&](double t, std::size_t) { return t + draw(generator); })),
          IsRate(800.0))
          << jitter;
    }
  }
}

TEST(TypicalStep, IsTheMeanStepOfBurstsAndPairs) {
  const auto in_turn = [](double first, double second) {
    std::vector<double> times = {0.0};
    while (times.size() < count)
      times.push_back(times.back() + (times.size() % 2 ? first : second));
    return times;
  };
  EXPECT_THAT(rate_of(in_turn(0.003, 0.007)), IsRate(200.0));
  EXPECT_THAT(rate_of(in_turn(0.001, 0.009)), IsRate(200.0));
  EXPECT_THAT(rate_of(in_turn(0.0, 0.002)), IsRate(1000.0));
  EXPECT_THAT(rate_of(in_turn(0.0005, 0.0015)), IsRate(1000.0));
  EXPECT_THAT(
      rate_of(sampled(
          1000.0, [](double t, std::size_t k) { return t - 1e-3 * static_cast<double>(k % 4); })),
      IsRate(1000.0))
      << "four equal stamps";
}

TEST(TypicalStep, IgnoresLostSamples) {
  for (const double share : {0.01, 0.05, 0.1, 0.3}) {
    for (const unsigned seed : {1U, 2U, 3U, 4U}) {
      std::mt19937 generator(seed);
      std::bernoulli_distribution is_lost(share);
      std::vector<double> times;
      for (int k = 0; times.size() < count; ++k) {
        if (!is_lost(generator)) times.push_back(1e-3 * k);
      }
      EXPECT_NEAR(rate_of(times), 1000.0, share < 0.04 ? 20.0 : 1.0) << share << ' ' << seed;
    }
  }
}

TEST(TypicalStep, IgnoresJumpsStepsBackAndMissingTimes) {
  const auto with = [](const auto& change) {
    std::vector<double> times = sampled(500.0, [](double t, std::size_t) { return t; });
    change(times);
    return rate_of(times);
  };
  EXPECT_THAT(with([](auto& t) { t.front() = -1.7e9; }), IsRate(500.0));
  EXPECT_THAT(with([](auto& t) {
                for (std::size_t k = 90; k < t.size(); ++k) t[k] += 3600.0;
              }),
              IsRate(500.0));
  EXPECT_THAT(with([](auto& t) {
                for (std::size_t k = 90; k < t.size(); ++k) t[k] -= 0.05;
              }),
              IsRate(500.0));
  EXPECT_THAT(with([](auto& t) { t[3] = t[70] = std::numeric_limits<double>::quiet_NaN(); }),
              IsRate(500.0));
}

TEST(TypicalStep, NeedsATimeAfterAnother) {
  EXPECT_FALSE(typical_step(std::vector<double>{}).has_value());
  EXPECT_FALSE(typical_step(std::vector<double>{3.0}).has_value());
  EXPECT_FALSE(typical_step(std::vector<double>{3.0, 3.0, 3.0}).has_value());
  EXPECT_FALSE(typical_step(std::vector<double>{3.0, 2.0, 1.0}).has_value());
}

TEST(NominalRate, IsTheOneThatALoggerWasSetTo) {
  EXPECT_EQ(nominal_rate(1003.0), 1000.0);
  EXPECT_EQ(nominal_rate(599.88), 600.0);
  EXPECT_EQ(nominal_rate(799.36), 800.0);
  EXPECT_EQ(nominal_rate(801.28), 800.0);
  EXPECT_EQ(nominal_rate(399.2), 400.0);
  EXPECT_NEAR(nominal_rate(333.0), 1000.0 / 3.0, 1e-9);
  EXPECT_EQ(nominal_rate(480.0), 480.0);
}

TEST(UnitOfStep, DistinguishesTheUnitsOfClocks) {
  for (const double rate : {100.0, 200.0, 400.0, 1000.0}) {
    EXPECT_EQ(unit_of_step(1.0 / rate), "");
    EXPECT_EQ(unit_of_step(1e3 / rate), "milliseconds");
    EXPECT_EQ(unit_of_step(1e6 / rate), "microseconds");
    EXPECT_EQ(unit_of_step(1e9 / rate), "nanoseconds");
  }
  EXPECT_EQ(unit_of_step(0.1), "") << "10 Hz";
}

TEST(UnitOfStep, OfAKnownPeriodAllowsForLostSamples) {
  for (const double period : {5e-5, 1e-3, 5e-3, 1e-2, 0.1}) {
    for (const double lost : {0.2, 1.0, 2.0, 9.0}) {
      EXPECT_EQ(unit_of_step(lost * period, period), "");
      EXPECT_EQ(unit_of_step(1e3 * lost * period, period), "milliseconds");
      EXPECT_EQ(unit_of_step(1e6 * lost * period, period), "microseconds");
      EXPECT_EQ(unit_of_step(1e9 * lost * period, period), "nanoseconds");
    }
    EXPECT_EQ(unit_of_step(50.0 * period, period), "") << "a slow log";
  }
}

}  // namespace
}  // namespace touchdown::logs
