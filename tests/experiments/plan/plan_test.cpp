#include "experiments/plan/plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace touchdown::experiments {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Fitted run 0, test runs 0 to 4, and run 1 of a study's group.
Plan seven_runs() {
  Plan plan;
  plan.runs.resize(7);
  plan.runs[0].role = RunRole::fit;
  for (std::size_t i = 1; i < 6; ++i) plan.runs[i].run = static_cast<std::int64_t>(i) - 1;
  plan.runs[6].run = 1;
  plan.runs[6].group = 1;
  return plan;
}

std::vector<std::size_t> kept(const Experiment& experiment) {
  Plan plan = seven_runs();
  keep_recordings(experiment, plan);
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < plan.runs.size(); ++i) {
    if (plan.runs[i].kept) indices.push_back(i);
  }
  return indices;
}

TEST(KeepRecordings, KeepsTestRunsThatAreFilmedOrDrawnStepByStep) {
  Experiment experiment;
  experiment.video.run = 1;
  EXPECT_THAT(kept(experiment), ElementsAre(2));
  experiment.detail.emplace().choice.run = 3;
  experiment.cross_simulator.emplace().overlay.run = 4;
  EXPECT_THAT(kept(experiment), ElementsAre(2, 4, 5));
}

TEST(KeepRecordings, KeepsAllOrNoneOfThem) {
  Experiment experiment;
  experiment.recordings = KeptRecordings::all;
  EXPECT_THAT(kept(experiment), ElementsAre(0, 1, 2, 3, 4, 5, 6));
  experiment.recordings = KeptRecordings::none;
  EXPECT_THAT(kept(experiment), IsEmpty());
}

}  // namespace
}  // namespace touchdown::experiments
