#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "experiments/config/experiment_yaml.hpp"
#include "experiments/run_experiment.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Experiment robot_experiment(const std::string& more) {
  return experiment_from_yaml(YamlDocument::parse(
      "name: served\nestimators: [shipped]\nfit: {scenarios: [scenarios/hop.yaml]}\n"
      "test: {scenarios: [scenarios/hop.yaml]}\nvideo: {enabled: false}\n" +
          more,
      "served.yaml"));
}

TEST(ServedRobots, ARefusedRequestMakesNoDirectory) {
  const ScratchFolder folder;
  EXPECT_THROW((void)run_experiment(robot_experiment("robot: models/upkie_heavy.yaml"),
                                    {.out = folder.path() / "out", .command = ""}),
               InputError);
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

/// The file of an experiment without the key, and its digest, stay as they were.
TEST(ServedRobots, TheKeyIsWrittenOnlyIfSet) {
  EXPECT_THAT(to_yaml(robot_experiment("")), Not(HasSubstr("transfer")));
  const std::string with = to_yaml(robot_experiment("transfer: true"));
  EXPECT_THAT(with, HasSubstr("transfer: true"));
  EXPECT_TRUE(experiment_from_yaml(YamlDocument::parse(with, "config.yaml")).transfer);
}

}  // namespace
}  // namespace touchdown::experiments
