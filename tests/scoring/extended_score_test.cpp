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

TEST(ExtendedScore, LeavesOutLightlyLoadedContact) {
  const ExtendedScore score = score_of_a_flight(30);
  EXPECT_EQ(score.loaded.points(), 2 * (1700 - 100));
  EXPECT_EQ(score.loaded.flight_as_contact, 2 * 30);
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

TEST(LoadScore, HasTheMedianTheCoverageAndTheShareOfSteps) {
  // Errors of 1, 2, 3 and 40 N with σ = 1.2 N, and one step without a load.
  LoadScore score;
  for (const double error : {1.0, -2.0, 3.0, 40.0}) score.add(26.0, {26.0 + error, 1.2});
  score.add(26.0, {});
  EXPECT_NEAR(score.median_error(), 2.0, 0.1);
  EXPECT_EQ(score.coverage(), 0.5);
  EXPECT_EQ(score.share(), 0.8);
  for (const double error : {29.0, 31.0, 78.0, 214.0, 3000.0}) {
    LoadScore large;
    large.add(26.0, {26.0 + error, 1.2});
    EXPECT_NEAR(large.median_error(), error, 0.016 * error);
  }
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
