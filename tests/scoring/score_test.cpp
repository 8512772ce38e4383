#include "scoring/score.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/random.hpp"

namespace touchdown::scoring {
namespace {

constexpr std::int64_t period_us = 1000;

/// Flights of random length 60–300 ms, 500–1000 ms apart.
ContactSequence random_truth(std::uint64_t seed) {
  ContactSequence truth;
  for (std::uint64_t i = 0; i < 12; ++i) {
    truth.insert(truth.end(), static_cast<std::size_t>(500 + 500 * uniform01(seed, i, 0)), 1);
    truth.insert(truth.end(), static_cast<std::size_t>(60 + 240 * uniform01(seed, i, 1)), 0);
  }
  truth.insert(truth.end(), 600, 1);
  return truth;
}

/// Decisions with probabilities of 0 and 1, `delay` steps late (early if negative).
Track delayed(const ContactSequence& truth, std::ptrdiff_t delay) {
  Track track;
  const auto last = static_cast<std::ptrdiff_t>(truth.size()) - 1;
  for (std::ptrdiff_t k = 0; k <= last; ++k) {
    const auto source = static_cast<std::size_t>(std::clamp(k - delay, std::ptrdiff_t{0}, last));
    track.contact.push_back(truth[source]);
    track.p_contact.push_back(truth[source]);
  }
  return track;
}

Score whole(const ContactSequence& truth, const Track& track) {
  return score(truth, track, {0}, period_us, {}).front();
}

TEST(Score, OfAPerfectEstimatorIsOneAndZeroMilliseconds) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const ContactSequence truth = random_truth(seed);
    const Score perfect = whole(truth, delayed(truth, 0));
    EXPECT_EQ(perfect.points.success(), 1.0);
    EXPECT_EQ(perfect.points.no_contact_precision(), 1.0);
    EXPECT_EQ(perfect.points.no_contact_recall(), 1.0);
    EXPECT_EQ(perfect.takeoff.events, 12);
    EXPECT_EQ(perfect.landing.events, 12);
    EXPECT_EQ(perfect.takeoff.precision(), 1.0);
    EXPECT_EQ(perfect.landing.recall(), 1.0);
    EXPECT_EQ(perfect.takeoff.latency_mean(), 0.0);
    EXPECT_EQ(perfect.landing.latency_deviation(), 0.0);
    EXPECT_EQ(perfect.calibration.brier(), 0.0);
  }
}

TEST(Score, LatencyShiftsByExactlyTheShiftOfThePredictions) {
  const ContactSequence truth = random_truth(7);
  for (const std::ptrdiff_t delay : {-20, -1, 1, 17, 59}) {
    const Score late = whole(truth, delayed(truth, delay));
    EXPECT_EQ(late.takeoff.latency_us, 12 * delay * period_us);
    EXPECT_EQ(late.landing.latency_us, 12 * delay * period_us);
    EXPECT_EQ(late.takeoff.precision(), 1.0);
    EXPECT_EQ(late.landing.recall(), 1.0);
  }
}

TEST(Score, CountsPointsAfterTheSkippedBeginning) {
  ContactSequence truth(1000, 1);
  std::fill(truth.begin() + 500, truth.begin() + 600, 0);
  Track track = delayed(truth, 0);
  std::fill(track.contact.begin(), track.contact.begin() + 300, 0);        // not scored
  std::fill(track.contact.begin() + 500, track.contact.begin() + 525, 1);  // 25 of 100 flight steps
  std::fill(track.contact.begin() + 800, track.contact.begin() + 815, 0);  // 15 of 600 contact ones
  const Classification points = whole(truth, track).points;
  EXPECT_EQ(points, (Classification{.contact_as_contact = 585,
                                    .contact_as_flight = 15,
                                    .flight_as_contact = 25,
                                    .flight_as_flight = 75}));
  EXPECT_DOUBLE_EQ(points.success(), 660.0 / 700.0);
  EXPECT_DOUBLE_EQ(points.contact_precision(), 585.0 / 610.0);
  EXPECT_DOUBLE_EQ(points.contact_recall(), 585.0 / 600.0);
  EXPECT_DOUBLE_EQ(points.no_contact_precision(), 75.0 / 90.0);
  EXPECT_DOUBLE_EQ(points.no_contact_recall(), 0.75);
  EXPECT_EQ(classify(truth, track.contact, {0}, period_us, {}).front(), points);
}

TEST(Score, OfSegmentsAddsUpToTheWhole) {
  const ContactSequence truth = random_truth(3);
  const Track track = delayed(truth, 30);
  const std::vector<std::size_t> segments = drop_segments(truth, 250);
  ASSERT_EQ(segments.size(), 12U);
  Score sum;
  for (const Score& segment : score(truth, track, segments, period_us, {})) {
    EXPECT_EQ(segment.takeoff.events, 1);
    EXPECT_EQ(segment.landing.events, 1);
    sum += segment;
  }
  const Score all = whole(truth, track);
  EXPECT_EQ(sum.points, all.points);
  EXPECT_EQ(sum.takeoff, all.takeoff);
  EXPECT_EQ(sum.landing, all.landing);
  EXPECT_EQ(sum.calibration.points, all.calibration.points);
  EXPECT_EQ(sum.scored_us, all.scored_us);
}

TEST(Score, OfTheRobotPoolsTheWheelsByAddingTheirCounts) {
  const std::array<ContactSequence, 2> truth = {random_truth(1), random_truth(1)};
  Prediction prediction;
  prediction.fill(delayed(truth[0], 0));
  prediction[static_cast<std::size_t>(View::right_wheel)] = delayed(truth[0], 40);
  const RobotScore robot = score(truth, prediction, {0}, period_us, {}).front();
  EXPECT_EQ(robot.wheels().takeoff.latency_mean(), 0.020);
  EXPECT_EQ(robot.wheels().points.points(), 2 * robot[View::left_wheel].points.points());
  EXPECT_EQ(robot[View::any_wheel].points.success(), 1.0);
}

TEST(Score, CountsFalseTakeoffsPerMinuteOfEachWheel) {
  const std::array<ContactSequence, 2> truth = {ContactSequence(6300, 1), ContactSequence(6300, 1)};
  Prediction prediction;
  prediction.fill(delayed(truth[0], 0));
  Track& left = prediction[static_cast<std::size_t>(View::left_wheel)];
  for (const std::ptrdiff_t begin : {100, 1000, 4000}) {  // the first is not scored
    std::fill_n(left.contact.begin() + begin, 30, 0);
  }
  const RobotScore robot = score(truth, prediction, {0}, period_us, {}).front();
  // Two in the 6 scored seconds.
  EXPECT_DOUBLE_EQ(robot[View::left_wheel].false_takeoffs_per_minute(), 20.0);
  EXPECT_EQ(robot[View::right_wheel].false_takeoffs_per_minute(), 0.0);
  EXPECT_DOUBLE_EQ(robot.wheels().false_takeoffs_per_minute(), 10.0);
  EXPECT_TRUE(std::isnan(Score{}.false_takeoffs_per_minute()));
}

TEST(Classification, WithoutFlightHasNoFlightMetrics) {
  Classification points;
  points.add(true, true);
  EXPECT_EQ(points.success(), 1.0);
  EXPECT_TRUE(std::isnan(points.no_contact_recall()));
  EXPECT_TRUE(std::isnan(points.no_contact_precision()));
  EXPECT_TRUE(std::isnan(Classification{}.success()));
}

TEST(Calibration, OfAKnownMixtureIsItsBrierScoreAndReliability) {
  Calibration calibration;
  for (int i = 0; i < 100; ++i) calibration.add(i < 70, 0.75);
  calibration.add(true, 1.0);
  calibration.add(false, 0.0);
  // 70·0.25² + 30·0.75² over 102 points.
  EXPECT_NEAR(calibration.brier(), (70 * 0.0625 + 30 * 0.5625) / 102.0, 1e-15);
  EXPECT_EQ(calibration.bin[7].points, 100);
  EXPECT_DOUBLE_EQ(calibration.bin[7].contact_frequency(), 0.7);
  EXPECT_DOUBLE_EQ(calibration.bin[7].mean_probability(), 0.75);
  EXPECT_EQ(calibration.bin[9].contact, 1);
  EXPECT_EQ(calibration.bin[0].contact, 0);
}

TEST(Metrics, AnUnknownNameSuggestsTheNearestOne) {
  EXPECT_THROW(metric_index("sucess"), InputError);
}

}  // namespace
}  // namespace touchdown::scoring
