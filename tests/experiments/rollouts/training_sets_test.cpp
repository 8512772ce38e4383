#include "experiments/rollouts/training_sets.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace touchdown::experiments {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

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
