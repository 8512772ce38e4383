#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "noise/sensor_chain.hpp"
#include "tests/noise/statistics.hpp"

namespace touchdown::noise {
namespace {

constexpr double clock_period = 0.001;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

const ChannelDraws knee_draws({7, 3}, NoiseChannel::left_knee_torque);

/// 0, 1, 2, …
std::vector<double> counting(std::size_t steps) {
  std::vector<double> values(steps);
  std::iota(values.begin(), values.end(), 0.0);
  return values;
}

/// Counting values as a channel's clock reports them. `missing` receives the missing records.
std::vector<double> reported(const SensorChannel& channel, std::size_t steps,
                             std::vector<std::uint8_t>* missing = nullptr) {
  std::vector<double> values = counting(steps);
  std::vector<std::uint8_t> marked;
  Clock<double>(channel, clock_period, knee_draws, nan).report(values, marked);
  if (missing != nullptr) *missing = marked;
  return values;
}

std::vector<double> held(double samples_per_step, std::size_t steps = 11) {
  return reported({.rate = samples_per_step / clock_period}, steps);
}

TEST(HeldSamples, OfFourHundredHertzAreReportedEveryThreeAndTwoMillisecondsInTurn) {
  EXPECT_EQ(held(0.4), (std::vector<double>{0, 0, 0, 3, 3, 5, 5, 5, 8, 8, 10}));
}

TEST(HeldSamples, OfAWholeShareOfTheRateAreHeldAlikeToTheEnd) {
  const auto values = held(0.1, 100'000);
  for (std::size_t k = 0; k < values.size(); ++k) {
    ASSERT_EQ(values[k], static_cast<double>(k - k % 10)) << k;
  }
}

TEST(HeldSamples, OfAnInstrumentThatIsAsFastAsTheReaderAreAllNew) {
  EXPECT_EQ(held(1.0), counting(11));
  EXPECT_EQ(held(8.0), counting(11));
}

TEST(Delay, RepeatsTheFirstValueAndThenTheOneOfSoManyStepsBefore) {
  EXPECT_EQ(reported({.delay = 0.002}, 6), (std::vector<double>{0, 0, 0, 1, 2, 3}));
  EXPECT_EQ(reported({.delay = 0.1}, 6), std::vector<double>(6, 0.0));
}

TEST(Delay, IsRoundedToWholeStepsAndComesAfterTheHeldSamples) {
  const auto delayed_by = [](double seconds) {
    std::vector<std::uint8_t> missing;
    std::vector<double> values = reported({.rate = 500.0, .delay = seconds}, 9, &missing);
    EXPECT_TRUE(missing.empty());
    return values;
  };
  EXPECT_EQ(delayed_by(0.0014), (std::vector<double>{0, 0, 0, 2, 2, 4, 4, 6, 6}));
  EXPECT_EQ(delayed_by(0.0016), (std::vector<double>{0, 0, 0, 0, 2, 2, 4, 4, 6}));
}

/// The dropouts of a run.
std::vector<DropoutInterval> dropouts_of(const Dropout& dropout, std::size_t steps = 4'000'000) {
  std::vector<DropoutInterval> dropouts;
  for (DropoutProcess all(dropout, clock_period, knee_draws); all.current().begin < steps;
       all.advance()) {
    dropouts.push_back({all.current().begin, std::min(steps, all.current().end)});
  }
  return dropouts;
}

TEST(Dropouts, HaveTheirRateTheirMeanLengthAndTheirShare) {
  const Dropout dropout{.rate = 0.004, .length = 0.02};
  const auto dropouts = dropouts_of(dropout);
  double dropped = 0.0;
  for (const DropoutInterval& interval : dropouts)
    dropped += static_cast<double>(interval.end - interval.begin);
  const auto count = static_cast<double>(dropouts.size());
  const double steps = 4e6;
  EXPECT_NEAR(count / (steps - dropped), dropout.rate, 5.0 * dropout.rate / std::sqrt(count));
  EXPECT_NEAR(dropped / count, 20.0, 5.0 * 20.0 / std::sqrt(count));
  // r·L of r·L + 1 − r steps.
  EXPECT_NEAR(dropped / steps, 0.08 / (0.08 + 0.996), 0.004);
}

TEST(Dropouts, HaveGeometricLengths) {
  const auto dropouts = dropouts_of({.rate = 0.05, .length = 0.005});
  for (const std::size_t longer : {1U, 3U, 10U}) {
    const auto count = static_cast<double>(dropouts.size());
    const auto over = static_cast<double>(std::count_if(
        dropouts.begin(), dropouts.end(),
        [&](const DropoutInterval& interval) { return interval.end - interval.begin > longer; }));
    const double expected = std::pow(0.8, static_cast<double>(longer));
    EXPECT_NEAR(over / count, expected, 5.0 * std::sqrt(expected / count)) << longer;
  }
}

TEST(Dropouts, ShorterThanAStepLastOneStep) {
  for (const DropoutInterval& interval : dropouts_of({.rate = 0.3, .length = 1e-4}, 1'000)) {
    EXPECT_EQ(interval.end - interval.begin, 1U);
  }
}

TEST(Dropouts, NeverBeginAtTheFirstStepAndEndWithTheRun) {
  const auto dropouts = dropouts_of({.rate = 1.0, .length = 1e3}, 50);
  ASSERT_EQ(dropouts.size(), 1U);
  EXPECT_EQ(dropouts.front().begin, 1U);
  EXPECT_EQ(dropouts.front().end, 50U);
  EXPECT_TRUE(dropouts_of({.rate = 1.0}, 1).empty());
}

TEST(Dropouts, OfALongerRunBeginAsThoseOfAShorterOne) {
  const Dropout dropout{.rate = 0.1, .length = 0.003};
  const auto few = dropouts_of(dropout, 1'000);
  const auto more = dropouts_of(dropout, 5'000);
  ASSERT_GT(few.size(), 10U);
  for (std::size_t i = 0; i + 1 < few.size(); ++i) {
    EXPECT_EQ(few[i].begin, more[i].begin);
    EXPECT_EQ(few[i].end, more[i].end);
  }
}

/// Counting values with dropouts of a kind. `missing` receives the missing records.
std::vector<double> dropped(DropoutKind kind, std::vector<std::uint8_t>& missing) {
  return reported({.dropout = {.kind = kind, .rate = 0.05, .length = 0.004}}, 1'000, &missing);
}

TEST(Dropouts, FreezeBlankOrMarkWhatTheyCoverByKind) {
  const auto dropouts = dropouts_of({.rate = 0.05, .length = 0.004}, 1'000);
  ASSERT_GT(dropouts.size(), 20U);
  std::vector<std::uint8_t> none, missing;
  const auto frozen = dropped(DropoutKind::frozen, none);
  const auto blank = dropped(DropoutKind::nan, none);
  EXPECT_TRUE(none.empty());
  EXPECT_EQ(dropped(DropoutKind::missing, missing), counting(1'000));
  auto next = dropouts.begin();
  for (std::size_t k = 0; k < 1'000; ++k) {
    while (next != dropouts.end() && next->end <= k) ++next;
    const bool inside = next != dropouts.end() && k >= next->begin;
    EXPECT_EQ(missing[k] != 0, inside) << k;
    EXPECT_EQ(std::isnan(blank[k]), inside) << k;
    EXPECT_EQ(frozen[k], inside ? frozen[next->begin - 1] : static_cast<double>(k));
  }
}

}  // namespace
}  // namespace touchdown::noise
