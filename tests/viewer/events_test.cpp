#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/viewer/watch.hpp"

namespace touchdown::viewer {
namespace {

using logs::LabelState;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Steps = std::vector<std::uint8_t>;

TEST(StepRanges, AreMaximal) {
  EXPECT_THAT(ranges_of({}), IsEmpty());
  EXPECT_THAT(ranges_of({0, 0}), IsEmpty());
  EXPECT_THAT(ranges_of({1}), ElementsAre(StepRange{0, 1}));
  EXPECT_THAT(ranges_of({1, 0, 1, 1}), ElementsAre(StepRange{0, 1}, StepRange{2, 4}));
}

constexpr std::uint8_t gap = 2;  ///< unknown; beside 0, air, and 1, contact

std::vector<LabelState> states(const Steps& steps) {
  std::vector<LabelState> states;
  for (const std::uint8_t step : steps) {
    states.push_back(step == gap ? LabelState::unknown
                     : step == 1 ? LabelState::contact
                                 : LabelState::air);
  }
  return states;
}

LoggedRun run_of(const Steps& left, const Steps& right) {
  LoggedRun run;
  run.recording.info.control_period_us = 1000;
  run.contact = {states(left), states(right)};
  run.recording.observation.resize(left.size());
  return run;
}

/// Each step lasts as long as the shortest flight that counts.
LoggedRun slow(LoggedRun run) {
  run.recording.info.control_period_us = 50'000;
  return run;
}

TEST(Flights, AreThoseOfEachWheelOrTheFirstEstimatorsWithoutTrueContact) {
  EXPECT_THAT(flights_of(slow(run_of({1, 0, 0, 1, 0}, {1, 1, 0, 0, 0}))),
              ElementsAre(StepRange{1, 3}, StepRange{2, 5}, StepRange{4, 5}));
  LoggedRun run = slow(run_of({}, {}));
  EXPECT_THAT(flights_of(run), IsEmpty());
  render::BeliefTrack belief;
  belief.contact = {Steps{1, 0, 0}, Steps{1, 0, 1}};
  run.beliefs = {belief};
  EXPECT_THAT(flights_of(run), ElementsAre(StepRange{1, 2}, StepRange{1, 3}));
}

TEST(Flights, AreNotShorterThanThoseOfTheScore) {
  Steps left(200, 1);
  std::fill_n(left.begin() + 10, 49, 0);
  std::fill_n(left.begin() + 100, 50, 0);
  EXPECT_THAT(flights_of(run_of(left, Steps(200, 1))), ElementsAre(StepRange{100, 150}));
}

TEST(UnknownContact, IsNeitherAFlightNorAnErrorNorDoesItHideOthers) {
  const Steps labels = {0, 0, 0, 0, 0, 0, gap, gap, gap, gap, gap, gap, 1, 1, 1, 1, 1, 1, gap};
  LoggedRun run = slow(run_of(labels, labels));
  EXPECT_THAT(flights_of(run), ElementsAre(StepRange{0, 6}, StepRange{0, 6}));
  render::BeliefTrack belief;
  belief.contact = {Steps(19, 0), Steps(19, 0)};
  run.beliefs = {belief};
  EXPECT_THAT(errors_of(run, 0), ElementsAre(StepRange{12, 18}));
  EXPECT_TRUE(is_known(run, 5));
  EXPECT_FALSE(is_known(run, 6));
  EXPECT_FALSE(is_known(run, 18));
  EXPECT_FALSE(is_known(run, 19)) << "beyond the end";
}

TEST(UnknownContact, OfAWholeRunLeavesTheFlightsToTheFirstEstimator) {
  LoggedRun run = slow(run_of(Steps(3, gap), Steps(3, gap)));
  render::BeliefTrack belief;
  belief.contact = {Steps{1, 0, 0}, Steps{1, 0, 1}};
  run.beliefs = {belief};
  EXPECT_THAT(flights_of(run), ElementsAre(StepRange{1, 2}, StepRange{1, 3}));
}

TEST(LabelledContact, IsThatOfEachRowsOwnTime) {
  logs::Recording recording;
  for (const double time : {0.0, 0.001, 0.005, 0.006, 0.007}) {  // 4 ms are missing
    recording.observation.emplace_back().time = time;
  }
  const auto contact = labelled_contact(
      recording, {"", {{0.0, 0.005, {true, false}}, {0.006, 0.007, {false, true}}}});
  EXPECT_EQ(contact[0], states({1, 1, gap, 0, 0}));
  EXPECT_EQ(contact[1], states({0, 0, gap, 1, 1}));
}

TEST(Errors, LastAtLeastFiveMilliseconds) {
  Steps truth(40, 1);
  LoggedRun run = run_of(truth, truth);
  render::BeliefTrack belief;
  belief.contact = {truth, truth};
  for (std::size_t k = 10; k < 14; ++k) belief.contact[0][k] = 0;  // 4 ms
  for (std::size_t k = 20; k < 23; ++k) belief.contact[0][k] = 0;  // 3 ms, then the other wheel
  for (std::size_t k = 23; k < 25; ++k) belief.contact[1][k] = 0;
  run.beliefs = {belief};
  EXPECT_THAT(errors_of(run, 0), ElementsAre(StepRange{20, 25}));
  EXPECT_THAT(errors_of(run, 1), IsEmpty()) << "no such estimator";
  run.contact = {};
  EXPECT_THAT(errors_of(run, 0), IsEmpty()) << "no true contact";
}

}  // namespace
}  // namespace touchdown::viewer
