#include "logs/log/label_edits.hpp"

#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scratch_folder.hpp"

namespace touchdown::logs {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
constexpr auto unknown = LabelState::unknown;
constexpr auto air = LabelState::air;
constexpr auto contact = LabelState::contact;
constexpr Wheels left = {true, false}, right = {false, true}, both = {true, true};
constexpr TimeRange log_range = {0.0, 10.0};
constexpr double label_step = 0.001;

/// On the ground, one wheel up, in the air, a gap, on the ground.
ContactIntervals some() {
  return {"",
          {{0, 1, {true, true}, .9},
           {1, 2, {true, false}, .6},
           {2, 3, {false, false}, .8},
           {5, 6, {true, true}}}};
}

std::string text(const ContactIntervals& labels) { return to_csv(labels); }

TEST(LabelEdits, EdgesOfAWheelAreWhereItsOwnContactChanges) {
  EXPECT_THAT(edges_of(some(), 0), ElementsAre(0, 2, 3, 5, 6));
  EXPECT_THAT(edges_of(some(), 1), ElementsAre(0, 1, 3, 5, 6));
  EXPECT_EQ(range_at(some(), 1.5, 0, log_range), (TimeRange{0, 2}));
  EXPECT_EQ(range_at(some(), 1.5, 1, log_range), (TimeRange{1, 3}));
  EXPECT_EQ(range_at(some(), 4, 0, log_range), (TimeRange{3, 5}));
  EXPECT_EQ(range_at(some(), 9, 0, log_range), (TimeRange{6, 10}));
}

TEST(LabelEdits, AMovedEdgeIsOfOneWheelAlone) {
  ContactIntervals labels = some();
  EXPECT_EQ(move_edge(labels, 0, 2, 1.5, label_step, log_range), 1.5);
  EXPECT_THAT(edges_of(labels, 0), ElementsAre(0, 1.5, 3, 5, 6));
  EXPECT_THAT(edges_of(labels, 1), ElementsAre(0, 1, 3, 5, 6));
  EXPECT_EQ(move_edge(labels, 0, 1.5, 0.5, label_step, log_range), 0.5) << "over the other wheel's";
  EXPECT_THAT(edges_of(labels, 1), ElementsAre(0, 1, 3, 5, 6));
  EXPECT_EQ(state_at(labels, 0.7, 0), air);
  EXPECT_EQ(state_at(labels, 0.7, 1), contact);
}

TEST(LabelEdits, AnEdgeStopsAStepBeforeItsNeighbour) {
  ContactIntervals labels = some();
  EXPECT_EQ(move_edge(labels, 0, 2, 9, label_step, log_range), 2.999);
  EXPECT_EQ(move_edge(labels, 0, 2.999, -4, label_step, log_range), 0.001);
  EXPECT_EQ(move_edge(labels, 0, 6, 50, label_step, log_range), 10.0) << "the log's end";
  EXPECT_EQ(move_edge(labels, 0, 0, -50, label_step, log_range), 0.0) << "the log's start";
  EXPECT_EQ(move_edge(labels, 0, 4, 4.5, label_step, log_range), 4.0) << "no edge";
}

TEST(LabelEdits, AnEdgeToUnknownTimeIsOfBothWheels) {
  ContactIntervals labels = some();
  EXPECT_EQ(move_edge(labels, 0, 3, 4, label_step, log_range), 4.0);
  EXPECT_EQ(state_at(labels, 3.5, 1), air);
  EXPECT_EQ(move_edge(labels, 1, 4, 1, label_step, log_range), 2.001) << "the other wheel's edge";
  EXPECT_EQ(state_at(labels, 2.001, 0), unknown);
}

TEST(LabelEdits, LabelsBeyondTheLogsEndStay) {
  ContactIntervals labels = {"", {{8, 9, {true, true}}, {9, 12, {false, false}}}};
  EXPECT_EQ(move_edge(labels, 0, 9, 11, label_step, log_range), 10.0);
  set_state(labels, {9.5, 10}, both, unknown);
  EXPECT_EQ(text(labels), "start,end,left,right\n8,9,1,1\n9,9.5,1,0\n10,12,0,0\n");
}

TEST(LabelEdits, RemovingTheOnlyIntervalLeavesNone) {
  ContactIntervals labels = {"", {{1, 2, {true, true}, .5}}};
  set_state(labels, {1, 2}, left, unknown);
  EXPECT_THAT(labels.intervals, IsEmpty());
  EXPECT_THAT(edges_of(labels, 0), IsEmpty());
  EXPECT_THAT(least_sure(labels), IsEmpty());
  EXPECT_EQ(range_at(labels, 4, 0, log_range), log_range);
  set_state(labels, {3, 4}, right, air);
  EXPECT_EQ(text(labels), "start,end,left,right\n3,4,0,0\n") << "both: nothing was known";
}

TEST(LabelEdits, AnIntervalThatIsSetMergesWithItsNeighbours) {
  ContactIntervals labels = {
      "",
      {{0, 1, {false, false}, .9}, {1, 1.006, {true, true}, .5}, {1.006, 2, {false, false}, .7}}};
  set_state(labels, {1, 1.006}, both, air);
  EXPECT_EQ(text(labels), "start,end,left,right,sure\n0,2,0,0,0.700\n");
}

TEST(LabelEdits, ASplitHasAnEdgeThatMoves) {
  ContactIntervals labels = some();
  split(labels, 0.25);
  EXPECT_THAT(edges_of(labels, 1), ElementsAre(0, 0.25, 1, 3, 5, 6));
  EXPECT_EQ(move_edge(labels, 1, 0.25, 0.5, label_step, log_range), 0.5);
  set_state(labels, {0.5, 1}, right, air);
  EXPECT_THAT(edges_of(labels, 1), ElementsAre(0, 0.5, 3, 5, 6));
  const std::string before = text(labels);
  for (const double time : {0.5, 4.0, 6.0, -1.0}) split(labels, time);
  EXPECT_EQ(text(labels), before) << "no interval, or its edge";
}

TEST(LabelEdits, WhatAPersonAcceptedIsNoLongerAmongTheLeastSure) {
  ContactIntervals labels = some();
  EXPECT_THAT(least_sure(labels), ElementsAre(1, 2, 0));
  accept(labels, {1, 2});
  EXPECT_THAT(least_sure(labels), ElementsAre(2, 0));
  const ScratchFolder folder;
  EXPECT_THAT(least_sure(read_contact_intervals(folder.write("a.csv", text(labels)))),
              ElementsAre(2, 0));
}

TEST(LabelEdits, AreUndoneAndDoneAgainWhateverWasSaved) {
  LabelHistory history(some());
  std::vector<std::string> saved = {text(history.labels())};
  for (const double time : {0.5, 1.5, 2.5}) {
    ContactIntervals edited = history.labels();
    split(edited, time);
    EXPECT_TRUE(history.edit(edited));
    EXPECT_FALSE(history.edit(edited)) << "no change";
    saved.push_back(text(history.labels()));
  }
  EXPECT_TRUE(history.undo() && history.undo());
  EXPECT_EQ(text(history.labels()), saved[1]);
  EXPECT_TRUE(history.redo());
  EXPECT_EQ(text(history.labels()), saved[2]);
  EXPECT_EQ(history.edits(), 2U);
  ContactIntervals edited = history.labels();
  edited.intervals.clear();
  EXPECT_TRUE(history.edit(edited));
  EXPECT_FALSE(history.redo()) << "what was undone is replaced";
  while (history.undo()) {
  }
  EXPECT_EQ(text(history.labels()), saved[0]);
}

/// The oracle keeps a state per millisecond.
TEST(LabelEdits, SetTheStateOfEveryMillisecondInTheirRange) {
  constexpr int size = 300;
  std::array<std::array<LabelState, size>, 2> expected;
  for (auto& wheel : expected) wheel.fill(unknown);
  ContactIntervals labels;
  std::mt19937 random(1);
  const auto draw = [&](int count) {
    return static_cast<int>(random() % static_cast<unsigned>(count));
  };
  for (int i = 0; i < 600; ++i) {
    const int begin = draw(size), end = begin + draw(40);
    const Wheels wheels = {draw(2) == 0, draw(2) == 0};
    const auto state = static_cast<LabelState>(draw(3));
    set_state(labels, {1e-3 * begin, 1e-3 * end}, wheels, state);
    for (int k = begin; k < std::min(end, size); ++k) {
      const auto at = static_cast<std::size_t>(k);
      const bool is_new = expected[0][at] == unknown;
      for (std::size_t w = 0; w < 2; ++w) {
        if (state == unknown || is_new || wheels.at(w)) expected.at(w)[at] = state;
      }
    }
    for (std::size_t w = 0; w < 2; ++w) {
      for (std::size_t k = 0; k < size; ++k) {
        ASSERT_EQ(state_at(labels, 1e-3 * static_cast<double>(k), w), expected.at(w)[k])
            << "edit " << i << ", wheel " << w << ", " << k << " ms";
      }
    }
    for (std::size_t k = 0; k < labels.intervals.size(); ++k) {
      ASSERT_LT(labels.intervals[k].start, labels.intervals[k].end);
      if (k > 0) {
        ASSERT_GE(labels.intervals[k].start, labels.intervals[k - 1].end);
      }
    }
  }
}

}  // namespace
}  // namespace touchdown::logs
