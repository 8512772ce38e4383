#include "scoring/extended_score.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace touchdown::scoring {
namespace {

/// Scores one flight from 1000 to 1200 of 2000 steps of 1 ms on both wheels. Its takeoff is
/// predicted `delay` steps late, its landing in time. The load is 5 N for 100 steps before the
/// takeoff.
ExtendedScore score_of_a_flight(std::size_t delay) {
  std::array<ContactSequence, 2> truth;
  std::array<std::vector<double>, 2> force;
  Prediction prediction;
  prediction.fill({ContactSequence(2000, 1), std::vector<double>(2000, 1.0)});
  for (std::size_t wheel = 0; wheel < 2; ++wheel) {
    truth[wheel].assign(2000, 1);
    force[wheel].assign(2000, 26.0);
    for (std::size_t k = 900; k < 1000; ++k) force[wheel][k] = 5.0;
    for (std::size_t k = 1000; k < 1200; ++k) {
      truth[wheel][k] = 0;
      force[wheel][k] = 0.0;
      prediction[wheel].contact[k] = k >= 1000 + delay ? 0 : 1;
    }
  }
  return extended_score(truth, force, prediction, 1000, {});
}

TEST(ExtendedScore, LeavesOutStepsNearEventsAndLightlyLoadedContact) {
  const ExtendedScore score = score_of_a_flight(30);
  // Of 1700 scored steps on each wheel, 40 and 10 are near the takeoff and the landing; 10 of the
  // 30 delayed steps are more than 20 ms from the takeoff.
  EXPECT_EQ(score.away_from_events.points(), 2 * (1700 - 50));
  EXPECT_EQ(score.away_from_events.flight_as_contact, 2 * 10);
  EXPECT_EQ(score.loaded.points(), 2 * (1700 - 100));
  EXPECT_EQ(score.loaded.flight_as_contact, 2 * 30);
}

TEST(ExtendedScore, ReportsLatenciesToTheMillisecond) {
  ExtendedScore sum = score_of_a_flight(7);
  for (int i = 0; i < 8; ++i) sum += score_of_a_flight(12);
  sum += score_of_a_flight(33);
  EXPECT_EQ(sum.takeoff.percentile(0.10), 7.0);
  EXPECT_EQ(sum.takeoff.percentile(0.90), 12.0);
  EXPECT_EQ(sum.takeoff.percentile(0.95), 33.0);
  EXPECT_TRUE(std::isnan(ExtendedScore{}.takeoff.percentile(0.5)));
}

TEST(ExtendedScore, ReportsSignedAndAbsoluteLatencies) {
  Latencies latencies;
  for (const std::int64_t ms : {-20, -3, 0, 1, 4}) latencies.add(1000 * ms);
  EXPECT_EQ(latencies.percentile(0.5), 0.0);
  EXPECT_EQ(latencies.absolute_percentile(0.5), 3.0);
  EXPECT_EQ(latencies.absolute_percentile(0.9), 20.0);
  EXPECT_DOUBLE_EQ(latencies.early_share(), 0.4);
  EXPECT_TRUE(std::isnan(Latencies().early_share()));
  EXPECT_EQ(score_of_a_flight(7).landing.percentile(1.0), 0.0);
}

/// Scores one wheel's predicted flights against a true flight from 1000 to 1200 of 2000 steps of 1
/// ms. The other wheel is always in contact, and predicted so.
ExtendedScore score_of(const std::vector<Flight>& predicted,
                       const std::vector<Flight>& truth = {{1000, 1200}}) {
  std::array<ContactSequence, 2> contact = {ContactSequence(2000, 1), ContactSequence(2000, 1)};
  Prediction prediction;
  prediction.fill({ContactSequence(2000, 1), std::vector<double>(2000, 1.0)});
  const auto mark = [](const std::vector<Flight>& flights, ContactSequence& sequence) {
    for (const Flight& flight : flights) {
      for (std::size_t k = flight.takeoff; k < flight.landing; ++k) sequence[k] = 0;
    }
  };
  mark(truth, contact[0]);
  mark(predicted, prediction[0].contact);
  const std::array<std::vector<double>, 2> force = {std::vector<double>(2000, 26.0),
                                                    std::vector<double>(2000, 26.0)};
  return extended_score(contact, force, prediction, 1000, {});
}

TEST(Flights, MatchWhereTheyShareMoreThanHalfOfTheirUnion) {
  EXPECT_EQ(score_of({{1000, 1200}}).flights.f1(), 1.0);
  EXPECT_EQ(score_of({{1050, 1240}}).flights.matched, 1);  // 150 of 240
  EXPECT_EQ(score_of({{1000, 1100}}).flights.matched, 0);  // 100 of 200: not more than half
  EXPECT_EQ(score_of({{1100, 1300}}).flights.matched, 0);  // 100 of 300
  EXPECT_EQ(score_of({}).flights.f1(), 0.0);
  EXPECT_TRUE(std::isnan(score_of({}, {}).flights.f1()));
}

TEST(Flights, ThatFlickerAreCountedMoreThanOnce) {
  // Predicted in two parts of 150 and 40 steps with a gap, and once where there is no flight.
  const ExtendedScore score = score_of({{1000, 1150}, {1160, 1200}, {1500, 1510}});
  EXPECT_EQ(score.flights.truth, 1);
  EXPECT_EQ(score.flights.predicted, 3);
  EXPECT_EQ(score.flights.matched, 1);
  EXPECT_DOUBLE_EQ(score.flights.f1(), 2.0 / 4.0);
  // Six switches, of which one takeoff and one landing are detections.
  EXPECT_EQ(score.extra_switches, 4);
}

TEST(Flights, ThatAreTooShortDoNotCount) {
  EXPECT_EQ(score_of({}, {{1000, 1030}}).flights.truth, 0);
  EXPECT_EQ(score_of({{1002, 1030}}, {{1000, 1030}}).flights.predicted, 0);
  EXPECT_EQ(score_of({{1002, 1030}}, {{1000, 1030}}).extra_switches, 0);
}

TEST(Flights, AreMatchedBeforeThoseAtShortHopsAreLeftOut) {
  // A hop of 20 ms, 10 ms after the landing. One prediction spans both: 200 of 230 steps match.
  EXPECT_EQ(score_of({{1000, 1230}}, {{1000, 1200}, {1210, 1230}}).flights.f1(), 1.0);
  // The same hop before the takeoff, and hops on both sides.
  EXPECT_EQ(score_of({{970, 1200}}, {{970, 990}, {1000, 1200}}).flights.f1(), 1.0);
  EXPECT_EQ(score_of({{970, 1230}}, {{970, 990}, {1000, 1200}, {1210, 1230}}).flights.f1(), 1.0);
  // By hand: truth 1. Predicted 3: one matches, one at the hop counts nowhere, one is wrong.
  const FlightCounts counts =
      score_of({{1000, 1190}, {1210, 1230}, {1500, 1600}}, {{1000, 1200}, {1210, 1230}}).flights;
  EXPECT_EQ(counts.truth, 1);
  EXPECT_EQ(counts.predicted, 2);
  EXPECT_EQ(counts.matched, 1);
  EXPECT_DOUBLE_EQ(counts.f1(), 2.0 / 3.0);
  // A prediction that touches a hop and matches nothing still counts nowhere.
  EXPECT_EQ(score_of({{1220, 1500}}, {{1000, 1200}, {1210, 1230}}).flights.predicted, 0);
}

TEST(Latencies, MedianIsTheMeanOfTheMiddleTwo) {
  const auto median_of = [](const std::vector<int>& latencies_ms) {
    Latencies latencies;
    for (const int ms : latencies_ms) latencies.add(1000 * ms);
    return latencies.absolute_median();
  };
  EXPECT_EQ(median_of({7}), 7.0);
  EXPECT_EQ(median_of({2, 5}), 3.5);
  EXPECT_EQ(median_of({2, 5, 90}), 5.0);
  EXPECT_EQ(median_of({1, -4, 7, 100}), 5.5);  // of 1, 4, 7, 100
  EXPECT_EQ(median_of({3, -3, 3, 3}), 3.0);
  EXPECT_TRUE(std::isnan(median_of({})));
}

TEST(Flights, BeforeTheScoredPartAreNone) {
  const ExtendedScore score = score_of({{100, 200}}, {{100, 200}});
  EXPECT_EQ(score.flights.truth, 0);
  EXPECT_EQ(score.flights.predicted, 0);
  EXPECT_EQ(score.extra_switches, 0);
}

TEST(LoadScore, HasTheMedianTheCoverageAndTheShareOfSteps) {
  // Errors of 1, 2, 3 and 40 N with σ = 1.2 N, and one step without a load.
  LoadScore score;
  for (const double error : {1.0, -2.0, 3.0, 40.0}) score.add(26.0, {26.0 + error, 1.2});
  score.add(26.0, {});
  EXPECT_NEAR(score.median_error(), 2.0, 0.1);
  EXPECT_EQ(score.coverage(), 0.5);
  EXPECT_EQ(score.share(), 0.8);
  LoadScore twice = score;
  twice += score;
  EXPECT_EQ(twice.steps, 10);
  EXPECT_EQ(twice.median_error(), score.median_error());
  EXPECT_EQ(twice.coverage(), score.coverage());
  EXPECT_TRUE(std::isnan(LoadScore().median_error()));
  EXPECT_TRUE(std::isnan(LoadScore().coverage()));
}

TEST(ExtendedScore, ComparesLoadsWithForcesAfterTheSkippedBeginning) {
  std::array<ContactSequence, 2> truth;
  std::array<std::vector<double>, 2> force;
  Prediction prediction;
  Belief belief;
  for (std::size_t wheel = 0; wheel < 2; ++wheel) {
    truth[wheel].assign(1000, 1);
    force[wheel].assign(1000, 26.0);
    belief.wheel[wheel].load = {wheel == 0 ? 25.0 : 29.0, 1.0};
  }
  for (int k = 0; k < 1000; ++k) add_step(prediction, belief);
  const LoadScore load = extended_score(truth, force, prediction, 1000, {}).load;
  EXPECT_EQ(load.steps, 2 * 700);
  EXPECT_EQ(load.share(), 1.0);
  EXPECT_EQ(load.coverage(), 0.5);
}

TEST(LogLoss, IsBoundedForCertainButWrongEstimates) {
  // Of 2 × 1700 scored steps, 200 in the air are predicted as contact with probability one.
  const ExtendedScore score = score_of({});
  EXPECT_EQ(score.steps, 2 * 1700);
  EXPECT_NEAR(score.log_loss, -200.0 * std::log(1e-6), 1e-6);
}

}  // namespace
}  // namespace touchdown::scoring
