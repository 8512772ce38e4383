#include "experiments/stages/pending_tasks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace touchdown::experiments {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// A plan of test runs in groups, with one task for each run.
struct SmallPlan {
  Plan plan;

  void add_group(const std::vector<Condition>& conditions) {
    plan.groups.push_back({"", conditions, {}, {}});
  }
  void add_run(std::size_t group, const std::string& simulator, std::int64_t number) {
    PlannedRun run;
    run.simulator = simulator;
    run.run = number;
    run.group = group;
    plan.runs.push_back(run);
    plan.tasks.push_back({plan.runs.size() - 1, 0, {}});
  }
};

FittedModels fits(const std::vector<std::string>& keys) {
  FittedModels models;
  for (const std::string& key : keys) models[key];
  return models;
}

TEST(PendingTasks, AreReadyOnceAllTheirFitsExist) {
  SmallPlan small;
  small.add_group({{"mujoco", "mujoco", "robust"},
                   {"bullet", "bullet", "robust"},
                   {"bullet", "mujoco", "robust"},        // a fit of the other engine
                   {"mujoco", "mujoco", "hmm", "", 1}});  // a refit
  small.add_run(0, "mujoco", 0);
  small.add_run(0, "bullet", 1);
  PendingTasks pending(small.plan, small.plan.all_tasks());
  EXPECT_THAT(pending.take_ready({}), IsEmpty());
  EXPECT_THAT(pending.take_ready(fits({"mujoco"})), IsEmpty());
  EXPECT_TRUE(pending.needs("mujoco"));
  EXPECT_TRUE(pending.needs("mujoco~1"));
  EXPECT_FALSE(pending.needs("bullet~1"));
  EXPECT_THAT(pending.take_ready(fits({"mujoco", "bullet"})), ElementsAre(1U));
  EXPECT_TRUE(pending.needs("bullet"));
  EXPECT_THAT(pending.take_ready(fits({"mujoco", "bullet", "mujoco~1"})), ElementsAre(0U));
  EXPECT_FALSE(pending.needs("bullet"));
  EXPECT_THAT(pending.take_all(), IsEmpty());
}

TEST(PendingTasks, OfOneSimulationAreReadyTogether) {
  SmallPlan small;
  small.add_group({{"mujoco", "mujoco", "robust"}});
  small.add_group({{"mujoco", "mujoco", "robust", "_harsh"}});
  small.add_run(0, "mujoco", 0);
  small.add_run(0, "mujoco", 1);
  small.add_run(1, "mujoco", 1);  // the simulation of the run before, with other sensors
  small.add_run(1, "mujoco", 2);
  PendingTasks pending(small.plan, small.plan.all_tasks());
  EXPECT_THAT(pending.take_ready(fits({"mujoco"})), ElementsAre(0U));
  EXPECT_TRUE(pending.needs("mujoco"));
  EXPECT_THAT(pending.take_ready(fits({"mujoco", "mujoco_harsh"})), ElementsAre(1U, 2U, 3U));
}

TEST(PendingTasks, AreThoseOfTheRangeAndAllAreTakenInTheEnd) {
  SmallPlan small;
  small.add_group({{"mujoco", "mujoco", "robust"}, {"bullet", "bullet", "robust"}});
  for (int i = 0; i < 4; ++i) small.add_run(0, i < 3 ? "mujoco" : "bullet", i);
  PendingTasks pending(small.plan, {1, 3});
  EXPECT_FALSE(pending.needs("bullet"));
  EXPECT_THAT(pending.take_all(), ElementsAre(1U, 2U));
  EXPECT_FALSE(pending.needs("mujoco"));
  EXPECT_THAT(pending.take_all(), IsEmpty());
}

}  // namespace
}  // namespace touchdown::experiments
