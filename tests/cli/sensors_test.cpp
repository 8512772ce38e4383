#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "logs/log/recording_file.hpp"
#include "program.hpp"
#include "result_files.hpp"

namespace touchdown::cli {
namespace {

using ::testing::Contains;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

/// A folder with the tiny experiment.
struct Sensors : InFolder {
  Sensors() { write_tiny_experiment(folder_); }
  /// Runs the experiment and returns its result files.
  std::map<std::string, std::size_t> run_with(const std::string& out,
                                              const std::string& flags = "") const {
    folder_.output_of("run tiny.yaml --no-pictures --set paper_tables=true --out " + out + " " +
                      flags);
    return result_files(folder_ / out);
  }
};

TEST_F(Sensors, ChangeSignalsAndFitsButNotRecordingsUnlessTheyAreIdeal) {
  const auto none = run_with("none");
  const auto ideal = run_with("ideal", "--set sensors=noise/profiles/ideal.yaml");
  EXPECT_THAT(different_files(none, ideal), IsEmpty());
  EXPECT_THAT(folder_.text("ideal/config.yaml"), Not(HasSubstr("sensors")));
  EXPECT_THAT(folder_.text("none/tables/tables.md"), Not(HasSubstr("sensors as in")));

  const auto harsh = run_with("harsh", "--set sensors=noise/profiles/harsh.yaml");
  const auto different = different_files(none, harsh);
  EXPECT_THAT(different, Each(Not(StartsWith("recordings/"))));
  for (const char* name : {"tables/success.csv", "tables/latency.csv", "models/mujoco_robust.npz",
                           "models/bullet_robust.npz", "config.yaml"}) {
    EXPECT_THAT(different, Contains(name));
  }
  EXPECT_THAT(folder_.text("harsh/config.yaml"), HasSubstr("sensors: noise/profiles/harsh.yaml"));
  EXPECT_THAT(folder_.text("harsh/tables/tables.md"),
              HasSubstr("sensors as in noise/profiles/harsh.yaml"));
  EXPECT_THAT(folder_.text("harsh/tables/success.csv"), Not(HasSubstr("nan,nan")));

  // The same bytes again, whatever the number of threads and the engines.
  const std::string again = "--set sensors=noise/profiles/harsh.yaml --set workers=";
  EXPECT_THAT(different_files(harsh, run_with("one", again + "1")), IsEmpty());
  const auto mujoco = run_with("mujoco", again + "2 --set simulators=[mujoco]");
  for (const char* same : {"models/mujoco_robust.npz", "recordings/mujoco_step_test_001.mpack"}) {
    EXPECT_EQ(mujoco.at(same), harsh.at(same)) << same;
  }
}

TEST_F(Sensors, ReportTheSignalsOfASimulatedRun) {
  const auto simulated = [&](const std::string& name, const std::string& flags) {
    folder_.output_of("simulate drawn:hops_7_000 --run 2 --set end.duration=1.5 -o " + name +
                      ".mpack " + flags);
    return logs::read_recording(folder_ / (name + ".mpack"));
  };
  const logs::Recording ideal = simulated("none", "");
  EXPECT_EQ(simulated("ideal", "--sensors noise/profiles/ideal.yaml").steps(), ideal.steps());
  EXPECT_EQ(folder_.text("ideal.mpack"), folder_.text("none.mpack"));

  const logs::Recording upkie = simulated("upkie", "--sensors noise/profiles/upkie.yaml");
  ASSERT_EQ(upkie.steps(), ideal.steps());
  std::size_t changed = 0;
  for (std::size_t k = 0; k < ideal.steps(); ++k) {
    EXPECT_EQ(upkie.truth[k].wheel_normal_force, ideal.truth[k].wheel_normal_force);
    changed +=
        upkie.observation[k].servo[1].torque != ideal.observation[k].servo[1].torque ? 1U : 0U;
    // A servo tracks its target with the zero that it reports.
    EXPECT_NEAR(upkie.action[k].servo[1].position - ideal.action[k].servo[1].position,
                upkie.action[0].servo[1].position - ideal.action[0].servo[1].position, 1e-12);
  }
  EXPECT_GT(changed, ideal.steps() * 9 / 10);
  EXPECT_NE(upkie.action[0].servo[1].position, ideal.action[0].servo[1].position);
  simulated("again", "--sensors noise/profiles/upkie.yaml");
  EXPECT_EQ(folder_.text("again.mpack"), folder_.text("upkie.mpack"));
}

TEST_F(Sensors, OfAProfileThatWasEditedAreAnotherRequest) {
  folder_.write("mine.yaml", "# Mine.\ntorque: {white: 0.1}\n");
  run_with("a", "--set sensors=mine.yaml");
  folder_.write("mine.yaml", "# Mine, and better documented.\ntorque: {white: 0.1}\n");
  run_with("a", "--set sensors=mine.yaml");
  folder_.write("mine.yaml", "torque: {white: 0.2}\n");
  folder_.expect_refusals(
      {{"run tiny.yaml --out a --set sensors=mine.yaml", {"holds experiment 'tiny'"}}});
  // A run that is finished uses the profile of the run, not the edited file.
  folder_.output_of("run a --no-pictures");
}

TEST_F(Sensors, OfAProfileThatIsWrongStopTheRunBeforeItBegins) {
  folder_.write("mine.yaml", "torque:\n  delay: -0.001\n");
  folder_.expect_refusals(
      {{"run tiny.yaml --out a --set sensors=mine.yaml", {"mine.yaml:2:10: torque.delay: "}},
       {"simulate step.yaml -o x.mpack --sensors noise/profiles/upkei.yaml", {"no such file"}}});
  EXPECT_FALSE(folder_.has("a"));
}

}  // namespace
}  // namespace touchdown::cli
