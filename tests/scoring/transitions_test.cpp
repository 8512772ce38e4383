#include "scoring/transitions.hpp"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace touchdown::scoring {
namespace {

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

/// True and predicted flights of 3000 steps, and what becomes of their takeoffs and landings.
struct Case {
  const char* what;
  std::vector<Flight> truth, predicted;
  std::vector<JudgedTransition> expected;
};

TEST(Transitions, AreDetectedMissedOrFalseByTheDefinitionOfThePaper) {
  const std::vector<Flight> one = {{1000, 1200}};
  for (const Case& c : std::vector<Case>{
           {"late",
            one,
            {{1077, 1218}},
            {{takeoff, detected, 1000, 77}, {landing, detected, 1200, 18}}},
           {"early inside the window",
            one,
            {{940, 1180}},
            {{takeoff, detected, 1000, -60}, {landing, detected, 1200, -20}}},
           {"a takeoff before its window",
            one,
            {{939, 1200}},
            {{takeoff, missed, 1000, 0},
             {takeoff, false_alarm, 939, 0},
             {landing, detected, 1200, 0}}},
           {"a takeoff after the flight",
            one,
            {{1200, 1230}},
            {{takeoff, missed, 1000, 0}, {landing, detected, 1200, 30}}},
           {"chatter inside the hold-off",
            one,
            {{1010, 1050}, {1060, 1205}, {1300, 1310}, {1440, 1450}},
            {{takeoff, detected, 1000, 10}, {landing, detected, 1200, 5}}},
           {"chatter after the hold-off",
            one,
            {{1000, 1200}, {1600, 1610}, {1620, 1640}},
            {{takeoff, detected, 1000, 0},
             {takeoff, false_alarm, 1600, 0},
             {landing, detected, 1200, 0},
             {landing, false_alarm, 1610, 0}}},
           {"false alarms farther apart than the hold-off",
            {},
            {{1000, 1010}, {1251, 1261}},
            {{takeoff, false_alarm, 1000, 0},
             {takeoff, false_alarm, 1251, 0},
             {landing, false_alarm, 1010, 0},
             {landing, false_alarm, 1261, 0}}},
           {"a landing that is never predicted",
            one,
            {{1005, 3000}},
            {{takeoff, detected, 1000, 5}, {landing, missed, 1200, 0}}},
           {"a flight at the end has no landing",
            {{2700, 3000}},
            {{2720, 3000}},
            {{takeoff, detected, 2700, 20}}},
           {"it counts if its window fits", {{2700, 3000}}, {}, {{takeoff, missed, 2700, 0}}},
           {"only 200 of the 250 ms window are in the run", {{2800, 3000}}, {}, {}},
           {"the same", {{2800, 3000}}, {{2810, 3000}}, {}},
           {"events in the skipped beginning", {}, {{50, 299}}, {}},
           {"the window would open at 280",
            {{340, 500}},
            {{340, 500}},
            {{landing, detected, 500, 0}}},
           {"a short flight", {{1000, 1049}}, {}, {}},
           {"a short flight is no false alarm", {{1000, 1049}}, {{1010, 1060}}, {}},
           {"a flight just long enough",
            {{1000, 1050}},
            {},
            {{takeoff, missed, 1000, 0}, {landing, missed, 1050, 0}}},
           {"one prediction detects one event",
            {{1000, 1200}, {1300, 1500}},
            {{1050, 1510}},
            {{takeoff, detected, 1000, 50},
             {takeoff, missed, 1300, 0},
             {landing, missed, 1200, 0},
             {landing, detected, 1500, 10}}},
           {"a constant sequence", {{0, 3000}}, {{0, 3000}}, {}}}) {
    EXPECT_EQ(judge_transitions(with_flights(3000, c.truth), with_flights(3000, c.predicted),
                                millisecond, {}),
              c.expected)
        << c.what;
  }
  EXPECT_THAT(judge_transitions({}, {}, millisecond, {}), IsEmpty());
  EXPECT_THAT(judge_transitions({1}, {0}, millisecond, {}), IsEmpty());
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
  const double last = LatencyHistogram::centre_ms(LatencyHistogram::bins - 1);
  for (const auto& [us, centre] :
       std::vector<std::pair<std::int64_t, double>>{{0, 0.0},
                                                    {2'000, 0.0},
                                                    {-2'000, 0.0},
                                                    {3'000, 5.0},
                                                    {-3'000, -5.0},
                                                    {250'000, 250.0},
                                                    {-10'000'000, LatencyHistogram::centre_ms(0)},
                                                    {10'000'000, last}}) {
    LatencyHistogram histogram;
    histogram.add(us);
    histogram += histogram;
    const auto bin = std::find(histogram.events.begin(), histogram.events.end(), 2);
    EXPECT_EQ(LatencyHistogram::centre_ms(static_cast<std::size_t>(bin - histogram.events.begin())),
              centre)
        << us;
  }
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
