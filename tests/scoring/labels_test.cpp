#include "scoring/labels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace touchdown::scoring {
namespace {

ContactSequence sequence(std::initializer_list<std::pair<int, int>> state_and_length) {
  ContactSequence result;
  for (const auto& [state, length] : state_and_length) {
    result.insert(result.end(), static_cast<std::size_t>(length), static_cast<std::uint8_t>(state));
  }
  return result;
}

constexpr double period = 0.001;
constexpr double upkie = 5.33922;  // kg

std::vector<double> forces(std::initializer_list<std::pair<double, int>> force_and_length) {
  std::vector<double> result;
  for (const auto& [force, length] : force_and_length) {
    result.insert(result.end(), static_cast<std::size_t>(length), force);
  }
  return result;
}

ContactSequence labels(const std::vector<double>& force, const LabelConfig& config = {},
                       double mass = upkie) {
  return contact_labels(force, period, mass, config);
}

/// The definition word by word: the mean decides, then air grows over neighbours without force
/// until nothing changes.
ContactSequence naive_labels(const std::vector<double>& force, const LabelConfig& config,
                             double mass = upkie) {
  const double threshold = config.share * mass * 9.81;
  const auto last = static_cast<int>(force.size()) - 1;
  ContactSequence contact;
  for (int k = 0; k <= last; ++k) {
    double sum = 0.0;
    int steps = 0;
    for (int i = 0; i <= last; ++i) {
      if (std::abs(i - k) * period > 0.5 * config.window + 1e-12) continue;
      sum += force[static_cast<std::size_t>(i)];
      ++steps;
    }
    contact.push_back(sum / steps > threshold ? 1 : 0);
  }
  for (bool grows = true; grows;) {
    grows = false;
    for (std::size_t k = 0; k < contact.size(); ++k) {
      const bool beside_air =
          (k > 0 && contact[k - 1] == 0) || (k + 1 < contact.size() && contact[k + 1] == 0);
      if (contact[k] == 0 || !beside_air || force[k] > threshold) continue;
      contact[k] = 0;
      grows = true;
    }
  }
  return contact;
}

TEST(ContactLabels, PlaceTakeoffsAndLandingsWhereTheForceChanges) {
  for (int flight = 11; flight < 200; flight += 7) {
    EXPECT_EQ(labels(forces({{26, 50}, {0, flight}, {26, 50}})),
              sequence({{1, 50}, {0, flight}, {1, 50}}))
        << flight;
  }
  // A wheel unloads slowly and lands hard: the edges are at the force's threshold, 0.995 N.
  EXPECT_EQ(labels(forces({{26, 30}, {8, 4}, {2, 4}, {0.9, 2}, {0, 40}, {90, 3}, {26, 30}})),
            sequence({{1, 38}, {0, 42}, {1, 33}}));
}

TEST(ContactLabels, TakeNoFlightShorterThanTheWindow) {
  for (const int flight : {1, 3, 7, 10}) {
    EXPECT_EQ(labels(forces({{26, 50}, {0, flight}, {26, 50}})), sequence({{1, 100 + flight}}));
  }
}

TEST(ContactLabels, TakeChatterWithAnImpulseAsContact) {
  for (const auto& [touch, gap] : {std::pair(1, 1), {1, 3}, {1, 4}, {2, 7}}) {
    std::vector<double> force(50, 26.0);
    while (force.size() < 90) {  // 40 ms with a mean of 5 N or more: gaps outlast touches
      force.insert(force.end(), static_cast<std::size_t>(gap), 0.0);
      force.insert(force.end(), static_cast<std::size_t>(touch), 25.0);
    }
    force.insert(force.end(), 50, 26.0);
    EXPECT_EQ(labels(force), ContactSequence(force.size(), 1)) << touch << " of " << touch + gap;
  }
}

TEST(ContactLabels, TakeATouchWithoutAnImpulseAsAir) {
  // 8 N for 1 ms are 0.7 N over 11 ms, and 30 N are 2.7 N.
  EXPECT_EQ(labels(forces({{26, 50}, {0, 30}, {8, 1}, {0, 30}, {26, 50}})),
            sequence({{1, 50}, {0, 61}, {1, 50}}));
  EXPECT_EQ(labels(forces({{26, 50}, {0, 30}, {30, 1}, {0, 30}, {26, 50}})),
            sequence({{1, 50}, {0, 30}, {1, 1}, {0, 30}, {1, 50}}));
}

TEST(ContactLabels, ScaleWithTheWeightOfTheRobot) {
  std::mt19937 random(3);
  std::vector<double> force(3000);
  double level = 26.0;
  for (double& f : force) {
    if (random() % 12 == 0)
      level = random() % 2 == 0 ? 0.0 : 0.01 * static_cast<double>(random() % 400);
    f = level;
  }
  for (const double factor : {0.2, 2.0, 10.0}) {
    std::vector<double> scaled = force;
    for (double& f : scaled) f *= factor;
    EXPECT_EQ(labels(scaled, {}, factor * upkie), labels(force)) << factor;
    EXPECT_NE(labels(scaled, {}, upkie), labels(force)) << factor;
  }
  EXPECT_NEAR(force_threshold({}, upkie), 1.0, 0.005);
}

TEST(Annotator, MarksTheStateOfTheLastFrameAndDelaysItsEvents) {
  struct Case {
    ContactSequence contact;
    Annotator annotator;
    ContactSequence expected;
  };
  const ContactSequence one_flight = sequence({{1, 15}, {0, 20}, {1, 15}});
  for (const auto& [contact, annotator, expected] : std::vector<Case>{
           // Frames at steps 0, 10, 20, ...; the wheel is in the air from 14 to 27, or between two.
           {sequence({{1, 14}, {0, 13}, {1, 23}}),
            {.frame = 0.01},
            sequence({{1, 20}, {0, 10}, {1, 20}})},
           {sequence({{1, 11}, {0, 8}, {1, 31}}), {.frame = 0.01}, sequence({{1, 50}})},
           {one_flight,
            {.frame = 0.0, .takeoff_delay = -0.007, .landing_delay = 0.003},
            sequence({{1, 8}, {0, 30}, {1, 12}})},
           {one_flight,
            {.frame = 0.0, .takeoff_delay = 0.02, .landing_delay = 0.0},
            sequence({{1, 50}})},
           // The ends of a run are not delayed; flights that overlap are one.
           {sequence({{0, 10}, {1, 30}, {0, 10}}),
            {.frame = 0.0, .takeoff_delay = 0.004, .landing_delay = 0.004},
            sequence({{0, 14}, {1, 30}, {0, 6}})},
           {sequence({{1, 10}, {0, 10}, {1, 5}, {0, 10}, {1, 15}}),
            {.frame = 0.0, .takeoff_delay = -0.003, .landing_delay = 0.003},
            sequence({{1, 7}, {0, 31}, {1, 12}})},
           {{}, {}, {}}}) {
    EXPECT_EQ(annotated(contact, 1e-3, annotator), expected);
  }
  ContactSequence contact;  // every step is seen at the robot's own rate
  for (int k = 0; k < 1000; ++k) contact.push_back(static_cast<std::uint8_t>(k * k % 7 < 3));
  EXPECT_EQ(annotated(contact, 1e-3, {.frame = 1e-3}), contact);
}

TEST(ContactLabels, AreAnnotatedLast) {
  std::vector<double> force(40, 50.0);
  std::fill(force.begin() + 8, force.begin() + 11, 0.0);   // shorter than the window
  std::fill(force.begin() + 18, force.begin() + 32, 0.0);  // contains the frames at 20 and 30
  EXPECT_EQ(labels(force, {.annotator = Annotator{.frame = 0.01}}), sequence({{1, 20}, {0, 20}}));
}

TEST(ContactLabels, NeedForceAboveTheThreshold) {
  const double newton = 1.0 / (upkie * 9.81);
  EXPECT_EQ(labels({0.0, 0.9, 1.1, std::nan(""), 50.0}, {.share = newton, .window = 0.0}),
            (ContactSequence{0, 0, 1, 0, 1}));
}

TEST(ContactLabels, RefuseARecordingWithoutGroundTruth) {
  logs::Recording recording;
  recording.observation.resize(3);
  EXPECT_THROW(contact_labels(recording, {}), InputError);
}

TEST(Flights, IncludeThoseAtTheEnds) {
  EXPECT_EQ(flights(sequence({{0, 2}, {1, 3}, {0, 4}})),
            (std::vector<Flight>{{.takeoff = 0, .landing = 2}, {.takeoff = 5, .landing = 9}}));
  EXPECT_TRUE(flights(sequence({{1, 3}})).empty());
}

TEST(DropSegments, EndMidwayBetweenDropsAndIncludeBounces) {
  // Drops at [100, 200) with a bounce at [210, 220), and at [1220, 1300).
  const ContactSequence contact =
      sequence({{1, 100}, {0, 100}, {1, 10}, {0, 10}, {1, 1000}, {0, 80}, {1, 100}});
  EXPECT_EQ(drop_segments(contact, 250), (std::vector<std::size_t>{0, 720}));
  EXPECT_EQ(drop_segments(contact, 5).size(), 3U);
  EXPECT_EQ(drop_segments({1, 1}, 5), std::vector<std::size_t>{0});
}

TEST(WheelCombinations, AreOrAndAnd) {
  const std::array<ContactSequence, 2> wheels = {ContactSequence{0, 0, 1, 1},
                                                 ContactSequence{0, 1, 0, 1}};
  EXPECT_EQ(any_wheel(wheels), (ContactSequence{0, 1, 1, 1}));
  EXPECT_EQ(both_wheels(wheels), (ContactSequence{0, 0, 0, 1}));
}

TEST(LabelStream, GivesTheLabelsOfTheDefinitionWithinTwoWindows) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 500; ++trial) {
    // Intervals of chatter, of light contact and of constant states.
    std::vector<double> force;
    const std::size_t steps = random() % 400;
    while (force.size() < steps) {
      const std::size_t length = 1 + random() % (random() % 4 == 0 ? 40 : 7);
      constexpr std::array<double, 5> levels = {0.0, 0.0, 0.5, 3.0,
                                                std::numeric_limits<double>::infinity()};
      force.insert(force.end(), length, levels[random() % levels.size()]);
    }
    for (const double window : {0.0, 0.001, 0.005, 0.01, 0.02}) {
      const LabelConfig config{.window = window};
      ContactSequence streamed;
      LabelStream stream(period, upkie, config,
                         [&](std::uint8_t contact) { streamed.push_back(contact); });
      std::size_t largest_delay = 0;
      for (std::size_t k = 0; k < force.size(); ++k) {
        stream.add(force[k]);
        largest_delay = std::max(largest_delay, k + 1 - streamed.size());
      }
      stream.finish();
      ASSERT_EQ(streamed, naive_labels(force, config)) << "trial " << trial << ", " << window;
      EXPECT_LE(static_cast<double>(largest_delay) * period, 2.0 * window + period);
    }
  }
}

}  // namespace
}  // namespace touchdown::scoring
