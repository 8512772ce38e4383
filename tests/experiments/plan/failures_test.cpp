#include <gtest/gtest.h>

#include "experiments/plan/rollouts.hpp"

namespace touchdown::experiments {
namespace {

Rollout run(const std::string& file, recordings::Outcome outcome, const std::string& ending) {
  Rollout run;
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
  using recordings::Outcome;
  const Rollout fallen = run("mujoco_stairs_fit_001.mpack", Outcome::fell, "fell after 13.6 s");
  const Rollout upright = run("mujoco_stairs_fit_000.mpack", Outcome::finished, "");
  const Rollout diverged =
      run("bullet_hop_test_000.mpack", Outcome::diverged, "diverged after 2 s");
  EXPECT_EQ(unused_runs_text({fallen, upright, fallen, diverged, fallen}),
            "Not used: mujoco_stairs_fit_001.mpack (fell after 13.6 s)\n"
            "Not used: bullet_hop_test_000.mpack (diverged after 2 s)\n");
  EXPECT_EQ(unused_runs_text({upright, upright}), "");
  EXPECT_EQ(unused_runs_text({}), "");
}

}  // namespace
}  // namespace touchdown::experiments
