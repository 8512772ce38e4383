#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include <gtest/gtest.h>

#include "noise/sensor_chain.hpp"
#include "tests/noise/statistics.hpp"

namespace touchdown::noise {
namespace {

constexpr double reading_period = 0.001;
constexpr std::size_t reading_count = 400'000;

/// The values as reported through a channel.
std::vector<double> through(const SensorChannel& channel, std::vector<double> values,
                            std::uint64_t run = 0) {
  ChannelDraws draws({7, run}, NoiseChannel::accelerometer_x);
  ChannelState state;
  disturb_values(values, channel, reading_period, draws, state);
  return values;
}

std::vector<double> of_nothing(const SensorChannel& channel, std::size_t steps = reading_count,
                               std::uint64_t run = 0) {
  return through(channel, std::vector<double>(steps), run);
}

TEST(SensorValues, AreScaledBiasedClippedAndRoundedInTurn) {
  using Values = std::vector<double>;
  for (const auto& [channel, values, expected] :
       std::vector<std::tuple<SensorChannel, Values, Values>>{
           {{.bias = {.value = 0.25}}, {1.0, -2.0}, {1.25, -1.75}},
           {{.scale = {.value = 0.5}, .bias = {.value = 1.0}}, {2.0, -4.0}, {4.0, -5.0}},
           {{.range = 2.0}, {-3.0, -2.0, 0.5, 2.5}, {-2.0, -2.0, 0.5, 2.0}},
           {{.resolution = 0.25}, {0.1, 0.13, -0.4, 1.0}, {0.0, 0.25, -0.5, 1.0}},
           // 1.25 is beyond the range by a part of a step.
           {{.range = 1.2, .resolution = 0.25}, {9.0}, {1.25}}}) {
    EXPECT_EQ(through(channel, values), expected);
  }
}

TEST(SensorValues, OfAMountRingAtItsFrequencyAfterAnImpactAndDecayByItsDamping) {
  constexpr double damping = 0.1;
  for (const double frequency : {17.0, 30.0, 80.0}) {
    std::vector<double> impact(2000);
    impact[100] = 50.0;
    const auto rings = through({.mount = {.frequency = frequency, .damping = damping}}, impact);
    for (std::size_t k = 0; k < 100; ++k) ASSERT_EQ(rings[k], 0.0);
    // Times and heights of the maxima, each by a parabola.
    std::vector<std::array<double, 2>> maxima;
    for (std::size_t k = 102; k + 1 < rings.size() && maxima.size() < 5; ++k) {
      const double slope = 0.5 * (rings[k + 1] - rings[k - 1]);
      const double bend = rings[k + 1] - 2.0 * rings[k] + rings[k - 1];
      if (rings[k] < rings[k - 1] || rings[k] <= rings[k + 1]) continue;
      maxima.push_back({(static_cast<double>(k) - slope / bend) * reading_period,
                        rings[k] - 0.5 * slope * slope / bend});
    }
    ASSERT_EQ(maxima.size(), 5U);
    const double root = std::sqrt(1.0 - damping * damping);
    EXPECT_NEAR((maxima[4][0] - maxima[0][0]) / 4.0, 1.0 / (frequency * root), 0.01 / frequency);
    EXPECT_NEAR(std::log(maxima[0][1] / maxima[4][1]) / 4.0,
                2.0 * std::numbers::pi * damping / root, 0.03);
  }
}

TEST(SensorValues, OfAMountRestInAConstantAndResonateAtItsFrequency) {
  const SensorChannel mounted = {.mount = {.frequency = 40.0, .damping = 0.05}};
  for (const double value : through(mounted, std::vector<double>(500, 9.81))) {
    ASSERT_NEAR(value, 9.81, 1e-9);
  }
  std::vector<double> sine(4000);
  for (std::size_t k = 0; k < sine.size(); ++k) {
    sine[k] = std::sin(2.0 * std::numbers::pi * 40.0 * reading_period * static_cast<double>(k));
  }
  const auto resonant = through(mounted, sine);
  const double gain = std::sqrt(1.0 + 4.0 * 0.05 * 0.05) / (2.0 * 0.05);
  EXPECT_NEAR(*std::max_element(resonant.end() - 1000, resonant.end()), gain, 0.02 * gain);
  // Beyond half the sample rate it is rigid.
  EXPECT_EQ(through({.mount = {.frequency = 500.0}}, sine), sine);
}

TEST(SensorValues, ADrawnBiasAndADrawnScaleErrorAreConstantInARunAndDifferFromRunToRun) {
  constexpr std::size_t runs = 20'000;
  std::vector<double> biases;
  std::vector<double> scales;
  for (std::uint64_t run = 0; run < runs; ++run) {
    const auto biased = through({.bias = {.value = 3.0, .sd = 0.5}}, {0.0, 0.0}, run);
    const auto scaled = through({.scale = {.sd = 0.1}}, {1.0, 1.0}, run);
    ASSERT_EQ(biased[0], biased[1]);
    ASSERT_EQ(scaled[0], scaled[1]);
    biases.push_back(biased[0] - 3.0);
    scales.push_back(scaled[0] - 1.0);
  }
  const double five_errors = 5.0 / std::sqrt(static_cast<double>(runs));
  EXPECT_NEAR(mean(biases), 0.0, 0.5 * five_errors);
  EXPECT_NEAR(correlation(biases), 0.25, 0.25 * std::sqrt(2.0) * five_errors);
  EXPECT_NEAR(mean(scales), 0.0, 0.1 * five_errors);
  EXPECT_NEAR(correlation(scales), 0.01, 0.01 * std::sqrt(2.0) * five_errors);
}

TEST(SensorValues, WhiteNoiseHasItsVarianceAndNoMemory) {
  const auto noise = of_nothing({.white = 2.0});
  const double five_errors = 5.0 / std::sqrt(static_cast<double>(reading_count));
  EXPECT_NEAR(correlation(noise), 4.0, 4.0 * std::sqrt(2.0) * five_errors);
  for (const std::size_t lag : {1U, 2U, 10U}) {
    EXPECT_NEAR(correlation(noise, lag), 0.0, 4.0 * five_errors) << lag;
  }
}

TEST(SensorValues, NormalWhiteNoiseIsTheSeriesOfItsDraws) {
  std::vector<double> normal(1'000);
  fill_standard_normal({7, 0}, static_cast<NoiseChannel>(4 + 7 * 256), 0, normal);
  EXPECT_EQ(of_nothing({.white = 1.0}, 1'000), normal);
}

/// Share of the values beyond ± this.
double share_beyond(const std::vector<double>& values, double limit) {
  const auto count = std::count_if(values.begin(), values.end(),
                                   [&](double value) { return std::abs(value) > limit; });
  return static_cast<double>(count) / static_cast<double>(values.size());
}

TEST(HeavyTails, HaveTheQuantilesOfStudentsTAtTheSameStandardDeviation) {
  // Two-sided quantiles of 5 %, 1 % and 0.1 %, from a table of Student's t distribution.
  struct Row {
    double freedom, percent_5, percent_1, percent_01;
  };
  for (const Row& row : {Row{3.0, 3.1824, 5.8409, 12.9240}, Row{4.0, 2.7764, 4.6041, 8.6103},
                         Row{5.0, 2.5706, 4.0321, 6.8688}, Row{10.0, 2.2281, 3.1693, 4.5869},
                         Row{30.0, 2.0423, 2.7500, 3.6460}}) {
    const auto noise = of_nothing({.white = 0.5, .degrees_of_freedom = row.freedom});
    const double scale = 0.5 * std::sqrt((row.freedom - 2.0) / row.freedom);
    const auto expect_share = [&](double quantile, double share) {
      const double error = std::sqrt(share * (1.0 - share) / static_cast<double>(reading_count));
      EXPECT_NEAR(share_beyond(noise, scale * quantile), share, 5.0 * error) << row.freedom;
    };
    expect_share(row.percent_5, 0.05);
    expect_share(row.percent_1, 0.01);
    expect_share(row.percent_01, 0.001);
  }
}

TEST(HeavyTails, HaveTheVarianceOfTheWhiteNoiseAndTheKurtosisOfStudentsT) {
  for (const double freedom : {12.0, 20.0, 1e6}) {
    const auto noise = of_nothing({.white = 2.0, .degrees_of_freedom = freedom});
    const double kurtosis = 3.0 + 6.0 / (freedom - 4.0);
    const double five_errors = 5.0 / std::sqrt(static_cast<double>(reading_count));
    EXPECT_NEAR(mean(noise), 0.0, 2.0 * five_errors) << freedom;
    EXPECT_NEAR(correlation(noise), 4.0, 4.0 * std::sqrt(kurtosis - 1.0) * five_errors) << freedom;
    std::vector<double> squares;
    for (const double value : noise) squares.push_back(0.25 * value * value);
    // Its variance is the 8th moment less the square of the 4th; with 12 degrees of freedom, 533.
    EXPECT_NEAR(correlation(squares), kurtosis, std::sqrt(533.0) * five_errors) << freedom;
  }
}

TEST(HeavyTails, AreIndependentFromStepToStep) {
  const auto noise = of_nothing({.white = 1.0, .degrees_of_freedom = 3.0});
  const double limit = 3.1824 * std::sqrt(1.0 / 3.0);  // exceeded with probability 0.05
  for (const std::size_t lag : {1U, 2U, 3U}) {
    std::size_t both = 0;
    for (std::size_t k = 0; k + lag < noise.size(); ++k) {
      both += std::abs(noise[k]) > limit && std::abs(noise[k + lag]) > limit ? 1U : 0U;
    }
    const double expected = 0.0025 * static_cast<double>(reading_count);
    EXPECT_NEAR(static_cast<double>(both), expected, 5.0 * std::sqrt(1.2 * expected)) << lag;
  }
}

TEST(HeavyTails, ScaleTheDrawsOfNormalNoiseAndDoNotDependOnTheLengthOfTheCalls) {
  const SensorChannel heavy{.white = 1.0, .degrees_of_freedom = 3.0};
  const auto normal = of_nothing({.white = 1.0}, 2'001), tails = of_nothing(heavy, 2'001);
  const auto almost = of_nothing({.white = 1.0, .degrees_of_freedom = 1e6}, 2'001);
  for (std::size_t k = 0; k < normal.size(); ++k) {
    EXPECT_EQ(std::signbit(tails[k]), std::signbit(normal[k])) << k;
    EXPECT_NEAR(almost[k], normal[k], 1e-4) << k;
  }
  ChannelDraws draws({7, 0}, NoiseChannel::accelerometer_x);
  ChannelState state;
  std::vector<double> in_parts(2'001);
  for (const auto& [first, steps] : {std::pair{0U, 1U}, {1U, 999U}, {1'000U, 1'001U}}) {
    disturb_values(std::span(in_parts).subspan(first, steps), heavy, reading_period, draws, state,
                   nullptr);
  }
  EXPECT_EQ(in_parts, tails);
}

TEST(SensorValues, AWalkBeginsAtZeroAndItsVarianceGrowsWithTime) {
  constexpr std::size_t runs = 4'000;
  std::vector<double> after_half, after_two;
  for (std::uint64_t run = 0; run < runs; ++run) {
    const auto walk = of_nothing({.walk = 0.3}, 2'001, run);
    ASSERT_EQ(walk.front(), 0.0);
    after_half.push_back(walk[500]);
    after_two.push_back(walk[2'000]);
  }
  const double five_errors = 5.0 * std::sqrt(2.0 / static_cast<double>(runs));
  EXPECT_NEAR(correlation(after_half), 0.09 * 0.5, 0.09 * 0.5 * five_errors);
  EXPECT_NEAR(correlation(after_two), 0.09 * 2.0, 0.09 * 2.0 * five_errors);
}

TEST(SensorValues, ColouredNoiseIsAFirstOrderGaussMarkovProcess) {
  constexpr double time_constant = 0.02;
  const auto noise = of_nothing({.coloured = {.sd = 1.5, .time_constant = time_constant}});
  // Samples 2τ apart count as independent; this is their number.
  const double independent =
      static_cast<double>(reading_count) * reading_period / (2.0 * time_constant);
  const double five_errors = 5.0 * 2.25 * std::sqrt(2.0 / independent);
  for (const std::size_t lag : {0U, 5U, 20U, 60U}) {
    const double expected =
        2.25 * std::exp(-static_cast<double>(lag) * reading_period / time_constant);
    EXPECT_NEAR(correlation(noise, lag), expected, five_errors) << lag;
  }
}

TEST(SensorValues, ColouredNoiseIsStationaryFromTheFirstStep) {
  std::vector<double> first;
  for (std::uint64_t run = 0; run < 20'000; ++run) {
    first.push_back(of_nothing({.coloured = {.sd = 1.5, .time_constant = 5.0}}, 1, run).front());
  }
  EXPECT_NEAR(correlation(first), 2.25, 2.25 * 5.0 * std::sqrt(2.0 / 20'000.0));
}

TEST(SensorValues, TheLowPassAnswersAStepExponentiallyAndBeginsAtRestOnTheFirstValue) {
  std::vector<double> step(200, 1.0);
  std::fill_n(step.begin(), 50, 0.0);
  const auto answer = through({.low_pass = 0.01}, step);
  EXPECT_EQ(answer[49], 0.0);
  for (const std::size_t k : {50U, 60U, 120U}) {
    const double since = static_cast<double>(k - 49) * reading_period;
    EXPECT_NEAR(answer[k], 1.0 - std::exp(-since / 0.01), 1e-12) << k;
  }
  EXPECT_EQ(through({.low_pass = 0.01}, {5.0, 5.0}), (std::vector{5.0, 5.0}));
}

TEST(SensorValues, WhiteNoiseIsAddedAfterTheLowPassAndColouredNoiseBefore) {
  const auto white = of_nothing({.low_pass = 0.1, .white = 1.0});
  EXPECT_EQ(white, of_nothing({.white = 1.0}));
  const auto coloured =
      of_nothing({.coloured = {.sd = 1.0, .time_constant = 1e-4}, .low_pass = 0.1});
  // White noise through a first-order filter of gain g keeps g/(2 − g) of its variance.
  const double gain = 1.0 - std::exp(-0.01);
  EXPECT_NEAR(correlation(coloured), gain / (2.0 - gain), 0.1 * gain / (2.0 - gain));
}

/// A wheel that turns at a constant speed (rad/s) from an angle on.
WheelTurns turning(double speed, double from, double order, std::size_t steps) {
  std::vector<double> position, velocity;
  for (std::size_t k = 0; k < steps; ++k) {
    position.push_back(from + speed * reading_period * static_cast<double>(k));
    velocity.push_back(speed);
  }
  return wheel_turns(position, velocity, order);
}

std::vector<double> shaken(const TurnsOfBoth& turns, double amplitude, std::uint64_t run) {
  ChannelDraws draws({7, run}, NoiseChannel::gyroscope_x);
  std::vector<double> values(turns[0].sine.size());
  ChannelState state;
  disturb_values(values, {.vibration = {.amplitude = amplitude}}, reading_period, draws, state,
                 &turns);
  return values;
}

/// Amplitude of the sine of this frequency (rad/s) in the values.
double amplitude_at(const std::vector<double>& values, double frequency) {
  std::complex<double> sum;
  for (std::size_t k = 0; k < values.size(); ++k) {
    sum += values[k] * std::polar(1.0, -frequency * reading_period * static_cast<double>(k));
  }
  return 2.0 * std::abs(sum) / static_cast<double>(values.size());
}

TEST(Vibration, IsASineAtTheWheelsFrequencyTimesItsOrderThatGrowsWithTheSpeed) {
  // 10 s are whole periods of all of these.
  for (const double turns : {2.0, 5.0}) {
    const double speed = 2.0 * std::numbers::pi * turns;
    const TurnsOfBoth left = {turning(-speed, 0.3, 3.0, 10'000), turning(0.0, 0.0, 3.0, 10'000)};
    const auto values = shaken(left, 0.01, 0);
    EXPECT_NEAR(amplitude_at(values, 3.0 * speed), 0.01 * speed, 1e-9);
    EXPECT_NEAR(amplitude_at(values, speed), 0.0, 1e-9);
    EXPECT_NEAR(correlation(values), 0.5 * std::pow(0.01 * speed, 2), 1e-9);
  }
}

TEST(Vibration, OfBothWheelsAddsUpAndAWheelThatStandsDoesNotShake) {
  const double slow = 2.0 * std::numbers::pi * 2.0, fast = 2.0 * std::numbers::pi * 3.0;
  const auto values =
      shaken({turning(slow, 0.0, 1.0, 10'000), turning(fast, 0.0, 1.0, 10'000)}, 0.1, 0);
  EXPECT_NEAR(amplitude_at(values, slow), 0.1 * slow, 1e-9);
  EXPECT_NEAR(amplitude_at(values, fast), 0.1 * fast, 1e-9);
  const WheelTurns still = turning(0.0, 1.0, 1.0, 100);
  EXPECT_EQ(shaken({still, still}, 0.1, 0), std::vector<double>(100));
  const WheelTurns turns = turning(10.0, 0.0, 1.0, 100);
  EXPECT_NE(shaken({turns, still}, 0.1, 0), shaken({still, turns}, 0.1, 0))
      << "phases of their own";
}

TEST(Vibration, HasAPhaseThatIsUniformOverTheRuns) {
  const TurnsOfBoth turns = {turning(1.0, 0.0, 1.0, 1), turning(0.0, 0.0, 1.0, 1)};
  std::vector<double> first;
  for (std::uint64_t run = 0; run < 20'000; ++run) first.push_back(shaken(turns, 1.0, run).front());
  // The sine of a uniform phase: mean 0, variance 1/2, fourth moment 3/8.
  const double five_errors = 5.0 / std::sqrt(20'000.0);
  EXPECT_NEAR(mean(first), 0.0, std::sqrt(0.5) * five_errors);
  EXPECT_NEAR(correlation(first), 0.5, std::sqrt(0.125) * five_errors);
}

TEST(ChannelDraws, OfEveryDisturbanceAreIndependentOfEachOtherAndOfTheWhiteNoiseOfTheGrid) {
  const NoiseKey key{3, 4};
  ChannelDraws draws(key, NoiseChannel::left_knee_torque);
  std::vector<std::vector<double>> all(1, std::vector<double>(100'000));
  fill_standard_normal(key, NoiseChannel::left_knee_torque, 0, all.front());
  for (const DrawnFor what :
       {DrawnFor::walk, DrawnFor::coloured, DrawnFor::white, DrawnFor::tail}) {
    const auto series = draws.series(what, 0, 100'000);
    all.emplace_back(series.begin(), series.end());
  }
  for (std::size_t a = 0; a < all.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      double sum = 0.0;
      for (std::size_t k = 0; k < all[a].size(); ++k) sum += all[a][k] * all[b][k];
      EXPECT_NEAR(sum / 1e5, 0.0, 5.0 / std::sqrt(1e5)) << a << " and " << b;
    }
  }
}

TEST(ChannelDraws, AreTheNumbersThatTheyHaveAlwaysBeen) {
  // Draws of earlier versions must stay the same.
  ChannelDraws draws({1, 2}, NoiseChannel::accelerometer_z);
  EXPECT_EQ(draws.constant(DrawnFor::bias),
            standard_normal({1, 2}, static_cast<NoiseChannel>(6 + 3 * 256), 0));
  EXPECT_EQ(draws.series(DrawnFor::white, 5, 4)[3],
            standard_normal({1, 2}, static_cast<NoiseChannel>(6 + 7 * 256), 8));
}

}  // namespace
}  // namespace touchdown::noise
