#include "experiments/plan/training_data.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace touchdown::experiments {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// A fitted run of an entry of `fit.segments`. The time of its signals is the step's index.
Rollout run_of(std::size_t entry, std::int64_t number, std::size_t steps,
               const std::string& simulator = "mujoco") {
  Rollout run;
  run.plan.role = RunRole::fit;
  run.plan.group = segment_group(entry);
  run.plan.simulator = simulator;
  run.signals.info.run = number;
  run.signals.info.control_period_us = 1000;
  for (std::size_t k = 0; k < steps; ++k) {
    Signals signals;
    signals.time = static_cast<double>(k);
    run.signals.signals.push_back(signals);
    for (std::size_t w = 0; w < models::wheel_count; ++w) {
      run.signals.contact[w].push_back(k % 2 == w ? 1 : 0);
      run.signals.normal_force[w].push_back(static_cast<double>(k));
    }
  }
  return run;
}

/// Adds rollouts in this order, as several threads do, and returns the engine's segments.
RunPointers cut_in_order(const std::vector<std::size_t>& order, const std::string& simulator,
                         const std::vector<TrainingSegments>& segments, Rollouts& runs) {
  SegmentCutter cutter(segments, runs);
  for (const std::size_t index : order) cutter.add(index);
  return training_segments_of(runs, simulator, segments);
}

std::vector<std::size_t> begins(const RunPointers& segments) {
  std::vector<std::size_t> all;
  for (const RunSignals* segment : segments) {
    all.push_back(static_cast<std::size_t>(segment->signals.front().time));
  }
  return all;
}

TEST(TrainingSegments, BeginAtTheNextOffsetRunByRun) {
  Rollouts runs;
  for (int i = 0; i < 7; ++i) runs[static_cast<std::size_t>(i)] = run_of(0, i, 1000);
  const std::vector<TrainingSegments> segments = {
      {.scenario = "a", .runs = 7, .after = 0.2, .length = 0.4, .offsets = 5}};
  const RunPointers cut = cut_in_order({0, 1, 2, 3, 4, 5, 6}, "mujoco", segments, runs);
  EXPECT_THAT(begins(cut), ElementsAre(200, 300, 400, 500, 600, 200, 300));
  for (const RunSignals* one : cut) {
    const RunSignals& segment = *one;
    ASSERT_EQ(segment.steps(), 400U);
    for (std::size_t w = 0; w < models::wheel_count; ++w) {
      EXPECT_EQ(segment.normal_force[w].front(), segment.signals.front().time);
      EXPECT_EQ(segment.normal_force[w].back(), segment.signals.back().time);
      EXPECT_EQ(segment.contact[w].front(), w == 0 ? 1 : 0);
      EXPECT_EQ(segment.contact[w].size(), 400U);
    }
  }
}

TEST(TrainingSegments, ComeFromTheFirstGoodRunsOfTheirEntryAndEngine) {
  Rollouts runs;
  for (std::size_t i = 0; i < 4; ++i) runs[i] = run_of(0, static_cast<std::int64_t>(i), 100);
  runs[4] = run_of(1, 10, 100);
  runs[5] = run_of(0, 20, 100, "bullet");
  runs[6] = run_of(0, 30, 100);
  runs[6].plan.role = RunRole::test;
  runs[1].report.outcome = logs::Outcome::fell;
  const std::vector<TrainingSegments> segments = {
      {.scenario = "a", .runs = 2, .after = 0.0, .length = 1.0},
      {.scenario = "b", .runs = 2, .after = 0.0, .length = 1.0}};
  std::vector<std::int64_t> numbers;
  for (const RunSignals* segment : cut_in_order({0, 1, 2, 3, 4, 5, 6}, "mujoco", segments, runs)) {
    numbers.push_back(segment->info.run);
  }
  EXPECT_THAT(numbers, ElementsAre(0, 2, 10));
}

TEST(TrainingSegments, AreShorterWhereTheRunEnds) {
  Rollouts runs = {{0, run_of(0, 0, 250)}};
  const std::vector<TrainingSegments> segments = {
      {.scenario = "a", .runs = 1, .after = 0.1, .length = 0.4, .offsets = 5}};
  const RunPointers cut = cut_in_order({0}, "mujoco", segments, runs);
  ASSERT_EQ(cut.size(), 1U);
  EXPECT_EQ(cut.front()->steps(), 150U);
}

TEST(TrainingSegments, DoNotDependOnTheOrderInWhichRunsAreThere) {
  const std::vector<TrainingSegments> segments = {
      {.scenario = "a", .runs = 5, .after = 0.1, .length = 0.2, .offsets = 3},
      {.scenario = "b", .runs = 2, .after = 0.0, .length = 0.3, .offsets = 2}};
  for (const std::vector<std::size_t>& order : {std::vector<std::size_t>{0, 1, 2, 3, 4, 5, 6, 7},
                                                {7, 6, 5, 4, 3, 2, 1, 0},
                                                {4, 0, 6, 2, 7, 1, 3, 5}}) {
    Rollouts runs;
    for (std::size_t i = 0; i < 6; ++i) runs[i] = run_of(0, static_cast<std::int64_t>(i), 1000);
    for (std::size_t i = 6; i < 8; ++i) runs[i] = run_of(1, static_cast<std::int64_t>(i), 1000);
    runs[2].report.outcome = logs::Outcome::fell;  // the offset of later runs moves
    EXPECT_THAT(begins(cut_in_order(order, "mujoco", segments, runs)),
                ElementsAre(100, 450, 800, 100, 450, 0, 700));
  }
}

TEST(TrainingSegments, HoldNoOtherStepsOnceTheyAreCut) {
  const std::vector<TrainingSegments> segments = {
      {.scenario = "a", .runs = 2, .after = 0.0, .length = 0.1, .offsets = 2}};
  Rollouts runs;
  for (std::size_t i = 0; i < 2; ++i) runs[i] = run_of(0, static_cast<std::int64_t>(i), 1000);
  SegmentCutter cutter(segments, runs);
  cutter.add(1);  // its offset depends on run 0
  EXPECT_EQ(runs[1].signals.steps(), 1000U);
  cutter.add(0);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(runs[i].signals.steps(), 100U);
    EXPECT_EQ(runs[i].signals.signals.capacity(), 100U);
  }
}

RunSignals piece(const std::string& simulator, const std::string& scene, std::int64_t run) {
  RunSignals signals;
  signals.info.simulator = simulator;
  signals.info.scenario = scene;
  signals.info.run = run;
  return signals;
}

std::vector<std::string> names_of(const RunPointers& runs) {
  std::vector<std::string> names;
  for (const RunSignals* run : runs) {
    names.push_back(run->info.simulator + " " + run->info.scenario + std::to_string(run->info.run));
  }
  return names;
}

TEST(TrainingSet, TakesItsPiecesFromTheScenesInTurn) {
  const std::vector<RunSignals> pieces = {piece("m", "stairs", 1), piece("m", "stairs", 2),
                                          piece("m", "stairs", 3), piece("m", "hop", 1),
                                          piece("m", "roam", 1),   piece("m", "roam", 2)};
  EXPECT_THAT(names_of(training_set(pointers_to(pieces), 0)), IsEmpty());
  EXPECT_THAT(names_of(training_set(pointers_to(pieces), 1)), ElementsAre("m stairs1"));
  EXPECT_THAT(names_of(training_set(pointers_to(pieces), 5)),
              ElementsAre("m stairs1", "m hop1", "m roam1", "m stairs2", "m roam2"));
  for (const std::size_t all : {6U, 7U, 1'000U}) {
    EXPECT_THAT(names_of(training_set(pointers_to(pieces), all)),
                ElementsAre("m stairs1", "m hop1", "m roam1", "m stairs2", "m roam2", "m stairs3"));
  }
}

TEST(TrainingSet, HasItsSizeInEveryEngine) {
  const std::vector<RunSignals> pieces = {piece("m", "stairs", 1), piece("b", "stairs", 1),
                                          piece("m", "stairs", 2), piece("b", "hop", 1),
                                          piece("b", "hop", 2)};
  EXPECT_THAT(names_of(training_set(pointers_to(pieces), 2)),
              ElementsAre("m stairs1", "m stairs2", "b stairs1", "b hop1"));
  // One engine has fewer pieces, as after failed runs.
  EXPECT_THAT(names_of(training_set(pointers_to(pieces), 3)),
              ElementsAre("m stairs1", "m stairs2", "b stairs1", "b hop1", "b hop2"));
}

TEST(TrainingSet, CountsTheSecondsThatAreUsed) {
  RunSignals run = piece("m", "stairs", 1);
  run.info.control_period_us = 5'000;
  run.signals.resize(400);
  EXPECT_DOUBLE_EQ(used_seconds(run, 0.0), 2.0);
  EXPECT_DOUBLE_EQ(used_seconds(run, 0.3), 1.7);
  EXPECT_DOUBLE_EQ(used_seconds(run, 2.5), 0.0);
}

}  // namespace
}  // namespace touchdown::experiments
