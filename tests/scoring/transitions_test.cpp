#include "scoring/transitions.hpp"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace touchdown::scoring {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using enum EventKind;
using enum Judgement;

constexpr double millisecond = 1e-3;

/// Contact everywhere except in the given intervals [takeoff, landing).
ContactSequence with_flights(std::size_t steps, const std::vector<Flight>& all) {
  ContactSequence contact(steps, 1);
  for (const Flight& flight : all) {
    for (std::size_t k = flight.takeoff; k < flight.landing; ++k) contact[k] = 0;
  }
  return contact;
}

std::vector<JudgedTransition> judge(const std::vector<Flight>& truth,
                                    const std::vector<Flight>& predicted,
                                    std::size_t steps = 3000) {
  return judge_transitions(with_flights(steps, truth), with_flights(steps, predicted), millisecond,
                           {});
}

const std::vector<Flight> one_flight = {{1000, 1200}};

TEST(Transitions, ALateDetectionHasPositiveLatency) {
  EXPECT_THAT(judge(one_flight, {{1077, 1218}}),
              ElementsAre(JudgedTransition{takeoff, detected, 1000, 77},
                          JudgedTransition{landing, detected, 1200, 18}));
}

TEST(Transitions, AnEarlyDetectionInsideTheWindowHasNegativeLatency) {
  EXPECT_THAT(judge(one_flight, {{940, 1180}}),
              ElementsAre(JudgedTransition{takeoff, detected, 1000, -60},
                          JudgedTransition{landing, detected, 1200, -20}));
}

TEST(Transitions, ATakeoffPredictedBeforeItsWindowIsMissedAndAFalseAlarm) {
  EXPECT_THAT(judge(one_flight, {{939, 1200}}),
              ElementsAre(JudgedTransition{takeoff, missed, 1000, 0},
                          JudgedTransition{takeoff, false_alarm, 939, 0},
                          JudgedTransition{landing, detected, 1200, 0}));
}

TEST(Transitions, ATakeoffPredictedAfterTheFlightIsMissed) {
  EXPECT_THAT(judge(one_flight, {{1200, 1230}}),
              ElementsAre(JudgedTransition{takeoff, missed, 1000, 0},
                          JudgedTransition{landing, detected, 1200, 30}));
}

TEST(Transitions, ChatterInsideTheHoldOffIsIrrelevant) {
  EXPECT_THAT(judge(one_flight, {{1010, 1050}, {1060, 1205}, {1300, 1310}, {1440, 1450}}),
              ElementsAre(JudgedTransition{takeoff, detected, 1000, 10},
                          JudgedTransition{landing, detected, 1200, 5}));
}

TEST(Transitions, ChatterAfterTheHoldOffIsOneFalseAlarmOfEachKind) {
  EXPECT_THAT(judge(one_flight, {{1000, 1200}, {1600, 1610}, {1620, 1640}}),
              ElementsAre(JudgedTransition{takeoff, detected, 1000, 0},
                          JudgedTransition{takeoff, false_alarm, 1600, 0},
                          JudgedTransition{landing, detected, 1200, 0},
                          JudgedTransition{landing, false_alarm, 1610, 0}));
}

TEST(Transitions, FalseAlarmsFartherApartThanTheHoldOffCountEach) {
  EXPECT_THAT(judge({}, {{1000, 1010}, {1251, 1261}}),
              ElementsAre(JudgedTransition{takeoff, false_alarm, 1000, 0},
                          JudgedTransition{takeoff, false_alarm, 1251, 0},
                          JudgedTransition{landing, false_alarm, 1010, 0},
                          JudgedTransition{landing, false_alarm, 1261, 0}));
}

TEST(Transitions, ALandingThatIsNeverPredictedIsMissed) {
  EXPECT_THAT(judge(one_flight, {{1005, 3000}}),
              ElementsAre(JudgedTransition{takeoff, detected, 1000, 5},
                          JudgedTransition{landing, missed, 1200, 0}));
}

TEST(Transitions, AFlightAtTheEndHasNoLandingAndCountsIfItsWindowFits) {
  EXPECT_THAT(judge({{2700, 3000}}, {{2720, 3000}}),
              ElementsAre(JudgedTransition{takeoff, detected, 2700, 20}));
  EXPECT_THAT(judge({{2700, 3000}}, {}), ElementsAre(JudgedTransition{takeoff, missed, 2700, 0}));
  // Only 200 of the 250 ms window are in the run: neither found nor missed.
  EXPECT_THAT(judge({{2800, 3000}}, {}), IsEmpty());
  EXPECT_THAT(judge({{2800, 3000}}, {{2810, 3000}}), IsEmpty());
}

TEST(Transitions, EventsInTheSkippedBeginningDoNotCount) {
  EXPECT_THAT(judge({}, {{50, 299}}), IsEmpty());
  // The window of a takeoff at 340 would open at 280.
  EXPECT_THAT(judge({{340, 500}}, {{340, 500}}),
              ElementsAre(JudgedTransition{landing, detected, 500, 0}));
}

TEST(Transitions, AShortFlightIsNeitherMissedNorAFalseAlarm) {
  EXPECT_THAT(judge({{1000, 1049}}, {}), IsEmpty());
  EXPECT_THAT(judge({{1000, 1049}}, {{1010, 1060}}), IsEmpty());
  EXPECT_EQ(judge({{1000, 1050}}, {}).size(), 2U);
}

TEST(Transitions, OnePredictionDetectsOneEvent) {
  // A takeoff predicted once, in the first of two flights 100 ms apart, does not detect the second.
  EXPECT_THAT(judge({{1000, 1200}, {1300, 1500}}, {{1050, 1510}}),
              ElementsAre(JudgedTransition{takeoff, detected, 1000, 50},
                          JudgedTransition{takeoff, missed, 1300, 0},
                          JudgedTransition{landing, missed, 1200, 0},
                          JudgedTransition{landing, detected, 1500, 10}));
}

TEST(Transitions, EmptyAndConstantSequencesHaveNone) {
  EXPECT_THAT(judge_transitions({}, {}, millisecond, {}), IsEmpty());
  EXPECT_THAT(judge_transitions({1}, {0}, millisecond, {}), IsEmpty());
  EXPECT_THAT(judge({{0, 3000}}, {{0, 3000}}), IsEmpty());
}

TEST(TransitionCounts, GiveThePrecisionRecallAndLatencyOfThePaper) {
  TransitionCounts counts;
  for (const std::int64_t latency : {10, 20, 60}) {
    counts.add({takeoff, detected, 0, latency}, 1000);
  }
  counts.add({takeoff, missed, 0, 0}, 1000);
  counts.add({takeoff, false_alarm, 0, 0}, 1000);
  EXPECT_DOUBLE_EQ(counts.precision(), 3.0 / 4.0);
  EXPECT_DOUBLE_EQ(counts.recall(), 3.0 / 4.0);
  EXPECT_DOUBLE_EQ(counts.latency_mean(), 0.030);
  // Deviations −20, −10, 30: 1400 / 2 = 700 ms².
  EXPECT_NEAR(counts.latency_deviation(), 1e-3 * std::sqrt(700.0), 1e-15);
}

TEST(LatencyHistogram, CountsEventsAroundItsCentresAndClampsOutliers) {
  LatencyHistogram histogram;
  const auto bin_of = [](std::int64_t us) {
    LatencyHistogram one;
    one.add(us);
    return static_cast<std::size_t>(std::find(one.events.begin(), one.events.end(), 1) -
                                    one.events.begin());
  };
  EXPECT_EQ(LatencyHistogram::centre_ms(bin_of(0)), 0.0);
  EXPECT_EQ(LatencyHistogram::centre_ms(bin_of(2'000)), 0.0);
  EXPECT_EQ(LatencyHistogram::centre_ms(bin_of(-2'000)), 0.0);
  EXPECT_EQ(LatencyHistogram::centre_ms(bin_of(3'000)), 5.0);
  EXPECT_EQ(LatencyHistogram::centre_ms(bin_of(-3'000)), -5.0);
  EXPECT_EQ(LatencyHistogram::centre_ms(bin_of(250'000)), 250.0);
  EXPECT_EQ(bin_of(-10'000'000), 0u);
  EXPECT_EQ(bin_of(10'000'000), LatencyHistogram::bins - 1);
  histogram.add(0);
  histogram += histogram;
  EXPECT_EQ(histogram.events[bin_of(0)], 2);
}

/// The histogram and the sums count the same events: the detected ones.
TEST(LatencyHistogram, CountsDetectedEventsOnly) {
  TransitionCounts counts;
  counts.add({EventKind::takeoff, Judgement::detected, 100, 20}, 1000);
  counts.add({EventKind::takeoff, Judgement::detected, 200, -5}, 1000);
  counts.add({EventKind::takeoff, Judgement::missed, 300, 0}, 1000);
  counts.add({EventKind::takeoff, Judgement::false_alarm, 400, 0}, 1000);
  double sum = 0.0;
  std::int64_t events = 0;
  for (std::size_t b = 0; b < LatencyHistogram::bins; ++b) {
    events += counts.latency.events[b];
    sum += counts.latency.events[b] * LatencyHistogram::centre_ms(b);
  }
  EXPECT_EQ(events, counts.detected);
  EXPECT_DOUBLE_EQ(sum / 2.0, 1e3 * counts.latency_mean());
}

TEST(TransitionCounts, WithoutEventsAreNotNumbers) {
  const TransitionCounts none;
  EXPECT_TRUE(std::isnan(none.precision()));
  EXPECT_TRUE(std::isnan(none.recall()));
  EXPECT_TRUE(std::isnan(none.latency_mean()));
  EXPECT_TRUE(std::isnan(none.latency_deviation()));
}

}  // namespace
}  // namespace touchdown::scoring
