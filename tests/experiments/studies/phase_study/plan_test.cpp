#include "experiments/studies/phase_study/plan.hpp"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "experiments/experiment_context.hpp"

namespace touchdown::experiments {
namespace {

Plan shipped_plan() {
  const YamlDocument file =
      YamlDocument::load(TOUCHDOWN_SOURCE_DIR "/experiments/phase_study.yaml");
  return whole_plan(request_of(experiment_from_yaml(file)));
}

TEST(PhaseStudy, FitsToTheSameRunsForEveryTest) {
  const Plan plan = shipped_plan();
  for (const PlannedRun& run : plan.runs) EXPECT_EQ(run.seed, run.role == RunRole::fit ? 1U : 2U);
  // In both engines four whole runs, and segments of 48 runs of stairs, one of hanging, one of
  // lifting.
  EXPECT_EQ(std::count_if(plan.runs.begin(), plan.runs.end(),
                          [](const PlannedRun& run) { return run.role == RunRole::fit; }),
            2 * (4 + 50));
}

TEST(PhaseStudy, EvaluatesEveryRunOfEverySceneOncePerNoiseSeed) {
  const Plan plan = shipped_plan();
  ASSERT_EQ(plan.groups.size(), 1 + more_scenes.size());
  for (std::size_t g = 0; g < plan.groups.size(); ++g) EXPECT_EQ(plan.runs_in(g).size(), 20U);
  EXPECT_EQ(plan.tasks.size(), 4U * 20U * 3U);
  std::set<std::string> files;
  for (const PlannedRun& run : plan.runs) files.insert(run.file);
  EXPECT_EQ(files.size(), plan.runs.size());
}

TEST(PhaseStudy, EvaluatesTransfersAndTheLearningCurveOnStairsOnly) {
  const Plan plan = shipped_plan();
  const std::vector<Condition>& stairs = plan.groups.front().conditions;
  const auto has = [&](const Condition& wanted) {
    return std::find(stairs.begin(), stairs.end(), wanted) != stairs.end();
  };
  EXPECT_TRUE(has({"bullet", "mujoco", "phase"}));
  for (const int segments : learning_curve) {
    EXPECT_TRUE(has({"mujoco", "mujoco", "phase", segments_fit(segments)}));
  }
  for (std::size_t g = 1; g < plan.groups.size(); ++g) {
    for (const Condition& condition : plan.groups[g].conditions) {
      EXPECT_TRUE(condition.is_fitted_in_domain());
    }
  }
}

}  // namespace
}  // namespace touchdown::experiments
