#include "scoring/operating_point.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace touchdown::scoring {
namespace {

using ::testing::ElementsAre;

TEST(OperatingPoint, LeavesBelowOneThresholdAndReturnsAboveTheOther) {
  const std::vector<double> p = {0.5, 0.3, 0.29, 0.6, 0.8, 0.81, 0.3, 0.1, 0.79};
  EXPECT_THAT(decisions(p, 0.001, {0.3, 0.8}), ElementsAre(1, 1, 0, 0, 0, 1, 1, 0, 0));
  EXPECT_THAT(decisions(p, 0.001, {0.3, 0.3}), ElementsAre(1, 1, 0, 1, 1, 1, 1, 0, 1));
  EXPECT_THAT(decisions({}, 0.001, {0.3, 0.8}), ElementsAre());
}

TEST(OperatingPoint, ADecisionThatContradictsItsProbabilityEndsAfterATime) {
  const OperatingPoint point = {0.3, 0.9, 0.6, 0.003};
  // Each number is P(contact) of 1 ms. Takeoff; 2 ms of .7 are too short; 3 ms are not.
  EXPECT_THAT(decisions({0.2, 0.7, 0.7, 0.5, 0.7, 0.7, 0.7, 0.7}, 0.001, point),
              ElementsAre(0, 0, 0, 0, 0, 0, 1, 1));
  // Likewise from contact: .5 is above `leave_below`.
  EXPECT_THAT(decisions({0.5, 0.5, 0.8, 0.5, 0.5, 0.5, 0.5}, 0.001, point),
              ElementsAre(1, 1, 1, 1, 1, 0, 0));
  // Thresholds decide at once, and the time is one, not a number of steps.
  EXPECT_THAT(decisions({0.5, 0.2, 0.95, 0.5, 0.5}, 0.002, point), ElementsAre(1, 0, 1, 1, 0));
  // Beyond the thresholds it is limited to them: P between the two never flickers.
  EXPECT_THAT(decisions({0.1, 0.7, 0.7, 0.85, 0.85, 0.91, 0.95}, 0.002, {0.3, 0.9, 0.99, 0.003}),
              ElementsAre(0, 0, 0, 0, 0, 1, 1));
}

using BothWheels = std::array<ContactSequence, models::wheel_count>;

/// Contact of 3 s at 1 kHz. The left wheel has these flights, the right one is always in contact.
BothWheels contact_except(const std::vector<Flight>& flights) {
  BothWheels contact = {ContactSequence(3000, 1), ContactSequence(3000, 1)};
  for (const Flight& flight : flights) {
    for (std::size_t k = flight.takeoff; k < flight.landing; ++k) contact[0][k] = 0;
  }
  return contact;
}

TEST(OperatingPoint, CountsSwitchesThatDetectNoFlight) {
  // The flight is predicted 4 ms late and interrupted for 3 ms; a second one is false.
  const OperatingScore score =
      operating_score(contact_except({{1000, 1200}}),
                      contact_except({{1004, 1100}, {1103, 1200}, {2000, 2010}}), 1000, {});
  EXPECT_EQ(score.flights, 1);
  EXPECT_EQ(score.found, 1);
  EXPECT_DOUBLE_EQ(score.takeoff_error(), 0.004);
  EXPECT_EQ(score.extra_switches, 4);  // landed and left, left and landed
  EXPECT_EQ(score.false_takeoffs, 1);
  EXPECT_EQ(score.points.flight_as_contact, 4 + 3);
  EXPECT_EQ(score.points.contact_as_flight, 10);
  EXPECT_EQ(score.points.points(), 2 * 2700);
  EXPECT_DOUBLE_EQ(score.extra_switches_per_minute(), 4.0 * 60.0 / 5.4);
  EXPECT_DOUBLE_EQ(score.extra_switches_per_flight(), 4.0);
  EXPECT_DOUBLE_EQ(score.false_takeoffs_per_minute(), 60.0 / 5.4);
}

TEST(OperatingPoint, CountsEarlyAndLateTakeoffErrorsAlike) {
  const BothWheels truth = contact_except({{1000, 1200}});
  EXPECT_DOUBLE_EQ(operating_score(truth, contact_except({{990, 1200}}), 1000, {}).takeoff_error(),
                   0.010);
  EXPECT_DOUBLE_EQ(operating_score(truth, contact_except({{1010, 1200}}), 1000, {}).takeoff_error(),
                   0.010);
}

TEST(OperatingPoint, ScoresOfRunsAdd) {
  const OperatingScore found =
      operating_score(contact_except({{1000, 1200}}), contact_except({{1002, 1200}}), 1000, {});
  const OperatingScore missed =
      operating_score(contact_except({{1000, 1200}}), contact_except({}), 1000, {});
  OperatingScore sum = found;
  sum += missed;
  EXPECT_EQ(sum.flights, 2);
  EXPECT_DOUBLE_EQ(sum.takeoff_recall(), 0.5);
  EXPECT_DOUBLE_EQ(sum.takeoff_error(), 0.002);
  EXPECT_EQ(sum.scored_us, 2 * 5'400'000);
  EXPECT_TRUE(std::isnan(missed.takeoff_error()));
  EXPECT_TRUE(std::isnan(operating_score(contact_except({}), contact_except({}), 1000, {})
                             .extra_switches_per_flight()));
}

}  // namespace
}  // namespace touchdown::scoring
