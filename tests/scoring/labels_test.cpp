#include "scoring/labels.hpp"

#include <algorithm>
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

TEST(Debounce, MergesStatesShorterThanItsLimitTheShortestFirst) {
  const ContactSequence at_the_limit = sequence({{1, 20}, {0, 5}, {1, 20}});
  for (const auto& [contact, expected] : std::vector<std::pair<ContactSequence, ContactSequence>>{
           {sequence({{1, 20}, {0, 4}, {1, 20}}), sequence({{1, 44}})},
           {at_the_limit, at_the_limit},
           // The 2-step contact splits a flight; it goes first and leaves 3 + 2 + 4 steps.
           {sequence({{1, 20}, {0, 3}, {1, 2}, {0, 4}, {1, 20}}),
            sequence({{1, 20}, {0, 9}, {1, 20}})},
           {sequence({{0, 2}, {1, 20}, {0, 3}}), sequence({{1, 25}})},  // ends have one neighbour
           {{}, {}},
           {{0}, {0}},
           {sequence({{1, 3}}), sequence({{1, 3}})}}) {
    EXPECT_EQ(debounced(contact, 5), expected);
  }
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

TEST(ContactLabels, AreAnnotatedAfterTheyAreDebounced) {
  std::vector<double> force(40, 50.0);
  std::fill(force.begin() + 8, force.begin() + 11, 0.0);   // shorter than the debounce
  std::fill(force.begin() + 18, force.begin() + 32, 0.0);  // contains the frames at 20 and 30
  EXPECT_EQ(contact_labels(force, 1e-3, {.annotator = Annotator{.frame = 0.01}}),
            sequence({{1, 20}, {0, 20}}));
}

TEST(ContactLabels, NeedForceAboveTheThreshold) {
  const std::vector<double> force = {0.0, 1.0, 1.1, std::nan(""), 50.0};
  EXPECT_EQ(contact_labels(force, 1e-3, {.force_threshold = 1.0, .debounce = 0.0}),
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

constexpr double period = 0.001;

struct Streamed {
  ContactSequence labels;
  std::size_t largest_delay = 0;
};

Streamed stream(const std::vector<double>& force, const LabelConfig& config) {
  Streamed result;
  LabelStream labels(period, config,
                     [&](std::uint8_t contact) { result.labels.push_back(contact); });
  for (std::size_t k = 0; k < force.size(); ++k) {
    labels.add(force[k]);
    result.largest_delay = std::max(result.largest_delay, k + 1 - result.labels.size());
  }
  labels.finish();
  return result;
}

TEST(LabelStream, LabelsLikeTheWholeSequence) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 2000; ++trial) {
    // Intervals of chatter and of constant contact.
    std::vector<double> force;
    const std::size_t steps = random() % 400;
    while (force.size() < steps) {
      const std::size_t length = 1 + random() % (random() % 4 == 0 ? 40 : 7);
      force.insert(force.end(), length, random() % 2 == 0 ? 0.0 : 26.0);
    }
    for (const double debounce : {0.0, 0.001, 0.005, 0.02}) {
      const LabelConfig config{1.0, debounce};
      ASSERT_EQ(stream(force, config).labels, contact_labels(force, period, config))
          << "trial " << trial << ", debounce " << debounce;
    }
  }
}

TEST(LabelStream, LabelsConstantStatesWithShortDelay) {
  std::vector<double> force(10'000, 26.0);
  for (std::size_t k = 5000; k < 5100; ++k) force[k] = k % 2 == 0 ? 0.0 : 26.0;
  EXPECT_LE(stream(force, {}).largest_delay, 105U);
}

TEST(LabelStream, LabelsEndlessChatterAfterAMinute) {
  std::vector<double> force(200'000);
  for (std::size_t k = 0; k < force.size(); ++k) force[k] = k % 4 < 2 ? 0.0 : 26.0;
  const Streamed result = stream(force, {});
  EXPECT_EQ(result.labels.size(), force.size());
  EXPECT_LE(result.largest_delay, 60'010U);
}

}  // namespace
}  // namespace touchdown::scoring
