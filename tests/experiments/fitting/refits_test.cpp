#include <map>
#include <set>

#include <gtest/gtest.h>

#include "experiments/fitting/fitting.hpp"

namespace touchdown::experiments {
namespace {

std::vector<RunSignals> runs_of(const std::vector<std::pair<std::string, std::string>>& places) {
  std::vector<RunSignals> runs;
  for (const auto& [simulator, scenario] : places) {
    RunSignals run;
    run.info.simulator = simulator;
    run.info.scenario = scenario;
    run.info.run = static_cast<std::int64_t>(runs.size());
    runs.push_back(std::move(run));
  }
  return runs;
}

std::vector<std::int64_t> numbers(const RunPointers& runs) {
  std::vector<std::int64_t> all;
  for (const RunSignals* run : runs) all.push_back(run->info.run);
  return all;
}

TEST(Refits, DrawAsManyRunsOfEverySceneAndEngine) {
  const auto runs = runs_of({{"mujoco", "stairs"},
                             {"mujoco", "stairs"},
                             {"mujoco", "roam"},
                             {"bullet", "stairs"},
                             {"bullet", "stairs"}});
  for (int number = 1; number <= 20; ++number) {
    std::map<std::pair<std::string, std::string>, int> counts;
    for (const RunSignals* run : drawn_anew(pointers_to(runs), 1, number)) {
      ++counts[{run->info.simulator, run->info.scenario}];
    }
    EXPECT_EQ((counts[{"mujoco", "stairs"}]), 2);
    EXPECT_EQ((counts[{"mujoco", "roam"}]), 1);
    EXPECT_EQ((counts[{"bullet", "stairs"}]), 2);
  }
}

TEST(Refits, AreDrawnWithReplacementAndDecidedBySeedAndNumber) {
  const auto runs = runs_of(std::vector<std::pair<std::string, std::string>>(10, {"mujoco", "a"}));
  const auto one = numbers(drawn_anew(pointers_to(runs), 1, 1));
  EXPECT_EQ(one, numbers(drawn_anew(pointers_to(runs), 1, 1)));
  EXPECT_NE(one, numbers(drawn_anew(pointers_to(runs), 1, 2)));
  EXPECT_NE(one, numbers(drawn_anew(pointers_to(runs), 2, 1)));
  // Every run about as often as any other: 200 draws of 10 expect 200 of each.
  std::map<std::int64_t, int> counts;
  bool any_twice = false;
  for (int number = 1; number <= 200; ++number) {
    const auto drawn = numbers(drawn_anew(pointers_to(runs), 1, number));
    any_twice = any_twice || std::set<std::int64_t>(drawn.begin(), drawn.end()).size() < 10;
    for (const std::int64_t run : drawn) ++counts[run];
  }
  EXPECT_TRUE(any_twice);
  ASSERT_EQ(counts.size(), 10U);
  for (const auto& [run, count] : counts) EXPECT_NEAR(count, 200, 60);
}

TEST(Refits, DrawScenesWhereEachHasOneRun) {
  std::vector<std::pair<std::string, std::string>> places;
  for (const char* scene : {"kerbs_7_000", "hops_7_001", "lifts_7_002", "drives_7_003"}) {
    places.emplace_back("mujoco", scene);
    places.emplace_back("bullet", scene);
  }
  places.emplace_back("bullet", "hops_7_001");  // Bullet has two runs of a scene
  const std::vector<RunSignals> runs = runs_of(places);
  std::set<std::set<std::string>> scenes;
  for (int number = 1; number <= 20; ++number) {
    std::map<std::string, int> in_bullet;
    std::set<std::string> in_mujoco;
    int count = 0;
    for (const RunSignals* run : drawn_anew(pointers_to(runs), 1, number)) {
      if (run->info.simulator == "bullet") ++in_bullet[run->info.scenario];
      if (run->info.simulator == "mujoco") in_mujoco.insert(run->info.scenario);
      count += run->info.simulator == "mujoco" ? 1 : 0;
    }
    EXPECT_EQ(count, 4);
    EXPECT_EQ(in_bullet,
              (std::map<std::string, int>{
                  {"kerbs_7_000", 1}, {"hops_7_001", 2}, {"lifts_7_002", 1}, {"drives_7_003", 1}}));
    scenes.insert(in_mujoco);
  }
  EXPECT_GT(scenes.size(), 3U);
  EXPECT_FALSE(scenes.contains(std::set<std::string>{}));
  const auto alone = runs_of({{"mujoco", "a"}});
  EXPECT_EQ(numbers(drawn_anew(pointers_to(alone), 1, 1)), std::vector<std::int64_t>{0});
}

}  // namespace
}  // namespace touchdown::experiments
