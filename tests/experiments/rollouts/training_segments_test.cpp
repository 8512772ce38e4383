#include "experiments/rollouts/training_segments.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace touchdown::experiments {
namespace {

using ::testing::ElementsAre;

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

std::vector<std::size_t> begins(const std::vector<RunSignals>& segments) {
  std::vector<std::size_t> all;
  for (const RunSignals& segment : segments) {
    all.push_back(static_cast<std::size_t>(segment.signals.front().time));
  }
  return all;
}

TEST(TrainingSegments, BeginAtTheNextOffsetRunByRun) {
  Rollouts runs;
  for (int i = 0; i < 7; ++i) runs[static_cast<std::size_t>(i)] = run_of(0, i, 1000);
  const std::vector<TrainingSegments> segments = {
      {.scenario = "a", .runs = 7, .after = 0.2, .length = 0.4, .offsets = 5}};
  const std::vector<RunSignals> cut = training_segments_of(runs, "mujoco", segments);
  EXPECT_THAT(begins(cut), ElementsAre(200, 300, 400, 500, 600, 200, 300));
  for (const RunSignals& segment : cut) {
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
  runs[1].report.outcome = recordings::Outcome::fell;
  const std::vector<TrainingSegments> segments = {
      {.scenario = "a", .runs = 2, .after = 0.0, .length = 1.0},
      {.scenario = "b", .runs = 2, .after = 0.0, .length = 1.0}};
  std::vector<std::int64_t> numbers;
  for (const RunSignals& segment : training_segments_of(runs, "mujoco", segments)) {
    numbers.push_back(segment.info.run);
  }
  EXPECT_THAT(numbers, ElementsAre(0, 2, 10));
}

TEST(TrainingSegments, AreShorterWhereTheRunEnds) {
  const Rollouts runs = {{0, run_of(0, 0, 250)}};
  const std::vector<TrainingSegments> segments = {
      {.scenario = "a", .runs = 1, .after = 0.1, .length = 0.4, .offsets = 5}};
  const std::vector<RunSignals> cut = training_segments_of(runs, "mujoco", segments);
  ASSERT_EQ(cut.size(), 1U);
  EXPECT_EQ(cut.front().steps(), 150U);
}

}  // namespace
}  // namespace touchdown::experiments
