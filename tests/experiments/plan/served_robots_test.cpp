#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "experiments/config/experiment_yaml.hpp"
#include "experiments/experiment_context.hpp"
#include "experiments/plan/plan.hpp"
#include "experiments/run_experiment.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

Experiment experiment_with(const std::string& more,
                           const std::string& estimators = "shipped, always_contact",
                           const std::string& scenario = "scenarios/hop.yaml") {
  return experiment_from_yaml(YamlDocument::parse(
      fmt::format("name: served\nsimulators: [mujoco]\nestimators: [{}]\n"
                  "fit: {{scenarios: [{}]}}\ntest: {{scenarios: [{}]}}\n"
                  "noise: {{torque: [0], accelerometer: [0]}}\nvideo: {{enabled: false}}\n"
                  "recordings: none\n{}\n",
                  estimators, scenario, scenario, more),
      "served.yaml"));
}

std::string complaint_about(const Experiment& experiment) {
  try {
    (void)whole_plan(request_of(experiment));
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(ServedRobots, AnotherRobotIsRefusedBeforeAnythingIsComputed) {
  for (const std::string robot :
       {"upkie_heavy", "upkie_long_legs", "ros_style", "knee_and_wheel"}) {
    const std::string key = "robot: models/" + robot + ".yaml";
    EXPECT_THAT(complaint_about(experiment_with(key)),
                AllOf(HasSubstr("shipped: "),
                      HasSubstr("was fitted to the robot 'upkie', not to '" + robot + "'"),
                      HasSubstr("`transfer: true`")))
        << robot;
    EXPECT_EQ(complaint_about(experiment_with(key + "\ntransfer: true")), "none") << robot;
    EXPECT_EQ(complaint_about(experiment_with(key, "free_fall")), "none") << robot;
  }
  for (const std::string robot :
       {"upkie.xml", "upkie_straight.yaml", "upkie_actuated.yaml", "upkie_straight_actuated.yaml",
        "upkie_rubber.yaml", "upkie_large_wheels.yaml"}) {
    EXPECT_EQ(complaint_about(experiment_with("robot: models/" + robot)), "none") << robot;
  }
}

TEST(ServedRobots, ARefusedRequestMakesNoDirectory) {
  const ScratchFolder folder;
  EXPECT_THROW((void)run_experiment(experiment_with("robot: models/upkie_heavy.yaml"),
                                    {.out = folder.path() / "out", .command = ""}),
               InputError);
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST(ServedRobots, AnotherRateIsRefused) {
  const ScratchFolder folder;
  for (const auto& [period, is_served] :
       {std::pair(500, false), std::pair(1000, true), std::pair(2500, true), std::pair(5000, true),
        std::pair(8000, false)}) {
    const std::string file = folder.write(
        "scene.yaml", fmt::format("{}\nsimulation: {{physics_step_us: 500, control_step_us: {}}}\n",
                                  read_file(TOUCHDOWN_SOURCE_DIR "/scenarios/hop.yaml"), period));
    const std::string complaint = complaint_about(experiment_with("", "shipped", file));
    EXPECT_THAT(complaint, is_served ? ::testing::Matcher<std::string>("none")
                                     : HasSubstr("serves 200 to 1000 Hz, not at "))
        << period;
    EXPECT_EQ(complaint_about(experiment_with("transfer: true", "shipped", file)), "none");
  }
}

TEST(ServedRobots, ContactFeedbackIsRefusedToo) {
  const std::string loop =
      "robot: models/upkie_heavy.yaml\nclosed_loop: {scenes: [{scenario: scenarios/hop.yaml}], "
      "contact: [shipped, truth], laws: [soft_landing], runs: 1}";
  EXPECT_THAT(complaint_about(experiment_with(loop, "shipped")),
              HasSubstr("was fitted to the robot 'upkie', not to 'upkie_heavy'"));
}

/// The file of an experiment without the key, and its digest, stay as they were.
TEST(ServedRobots, TheKeyIsWrittenOnlyIfSet) {
  EXPECT_THAT(to_yaml(experiment_with("")), Not(HasSubstr("transfer")));
  const std::string with = to_yaml(experiment_with("transfer: true"));
  EXPECT_THAT(with, HasSubstr("transfer: true"));
  EXPECT_TRUE(experiment_from_yaml(YamlDocument::parse(with, "config.yaml")).transfer);
}

}  // namespace
}  // namespace touchdown::experiments
