#include "experiments/plan/plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/plan/rollouts.hpp"

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

std::vector<std::size_t> kept(const Experiment& experiment, Plan plan = seven_runs()) {
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
  Plan with_study = seven_runs();
  with_study.pictured = {4};
  EXPECT_THAT(kept(experiment, with_study), ElementsAre(2, 4, 5));
}

TEST(KeepRecordings, KeepsAllOrNoneOfThem) {
  Experiment experiment;
  experiment.recordings = KeptRecordings::all;
  EXPECT_THAT(kept(experiment), ElementsAre(0, 1, 2, 3, 4, 5, 6));
  experiment.recordings = KeptRecordings::none;
  EXPECT_THAT(kept(experiment), IsEmpty());
}

FinishedRun run(const std::string& file, logs::Outcome outcome, const std::string& ending) {
  FinishedRun run;
  run.plan.file = file;
  run.report.outcome = outcome;
  run.report.ending = ending;
  return run;
}

TEST(FailuresText, NamesTheFirstAndCountsTheOthers) {
  EXPECT_EQ(failures_text({}), "there is none");
  EXPECT_EQ(failures_text({{"a", "fell after 1 s"}}), "a fell after 1 s");
  EXPECT_EQ(failures_text({{"b", "fell"}, {"a", "diverged"}}), "a diverged, and 1 other");
  EXPECT_EQ(failures_text({{"b", "fell"}, {"a", "sank"}, {"c", "fell"}}), "a sank, and 2 others");
}

/// The same simulated run, with the errors of three sensor profiles, is three runs of a plan.
TEST(UnusedRuns, HaveOneLineForEachRecording) {
  using logs::Outcome;
  const FinishedRun fallen = run("mujoco_stairs_fit_001.mpack", Outcome::fell, "fell after 13.6 s");
  const FinishedRun upright = run("mujoco_stairs_fit_000.mpack", Outcome::finished, "");
  const FinishedRun diverged =
      run("bullet_hop_test_000.mpack", Outcome::diverged, "diverged after 2 s");
  EXPECT_EQ(unused_runs_text({fallen, upright, fallen, diverged, fallen}),
            "Not used: mujoco_stairs_fit_001.mpack (fell after 13.6 s)\n"
            "Not used: bullet_hop_test_000.mpack (diverged after 2 s)\n");
  EXPECT_EQ(unused_runs_text({upright, upright}), "");
  EXPECT_EQ(unused_runs_text({}), "");
}

}  // namespace
}  // namespace touchdown::experiments
