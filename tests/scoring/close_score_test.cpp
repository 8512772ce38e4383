#include "scoring/close_score.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace touchdown::scoring {
namespace {

/// One flight from 1000 to 1200 of 2000 steps of 1 ms on both wheels, told `late` steps late at its
/// takeoff and in time at its landing; the load is light for 100 steps before the takeoff.
CloseScore score_of_a_flight(std::size_t late) {
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
      prediction[wheel].contact[k] = k >= 1000 + late ? 0 : 1;
    }
  }
  return close_score(truth, force, prediction, 1000, {});
}

TEST(CloseScore, LeavesOutWhatIsNearEventsAndWhatTouchesLightly) {
  const CloseScore close = score_of_a_flight(30);
  // Of 1700 scored steps on each wheel, 40 and 10 are near the takeoff and the landing; 10 of the
  // 30 late ones lie further away than 20 ms.
  EXPECT_EQ(close.away_from_events.points(), 2 * (1700 - 50));
  EXPECT_EQ(close.away_from_events.flight_as_contact, 2 * 10);
  EXPECT_EQ(close.firm.points(), 2 * (1700 - 100));
  EXPECT_EQ(close.firm.flight_as_contact, 2 * 30);
}

TEST(CloseScore, TellsLatenciesToTheMillisecond) {
  CloseScore sum = score_of_a_flight(7);
  for (int i = 0; i < 8; ++i) sum += score_of_a_flight(12);
  sum += score_of_a_flight(33);
  EXPECT_EQ(sum.takeoff_percentile(0.10), 7.0);
  EXPECT_EQ(sum.takeoff_percentile(0.90), 12.0);
  EXPECT_EQ(sum.takeoff_percentile(0.95), 33.0);
  EXPECT_TRUE(std::isnan(CloseScore{}.takeoff_percentile(0.5)));
}

}  // namespace
}  // namespace touchdown::scoring
