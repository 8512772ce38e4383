#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "logs/log/recording_file.hpp"
#include "program.hpp"
#include "result_files.hpp"

namespace touchdown::cli {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

/// Runs the tiny experiment and returns its result files.
std::map<std::string, std::size_t> run_with(const ScratchFolder& folder, const std::string& out,
                                            const std::string& flags = "") {
  const Ended ended = touchdown_program(
      "run tiny.yaml --set paper_tables=true --out " + out + " " + flags, folder.path());
  EXPECT_EQ(ended.exit_code, 0) << ended.errors;
  return result_files(folder / out);
}

TEST(Sensors, ThatAreIdealGiveTheBytesOfAnExperimentThatNamesNone) {
  const ScratchFolder folder;
  write_tiny_experiment(folder);
  const auto none = run_with(folder, "none");
  const auto ideal = run_with(folder, "ideal", "--set sensors=noise/profiles/ideal.yaml");
  EXPECT_THAT(different_files(none, ideal), IsEmpty());
  EXPECT_THAT(read_file(folder / "ideal/config.yaml"), Not(HasSubstr("sensors")));
  EXPECT_THAT(read_file(folder / "none/tables/tables.md"), Not(HasSubstr("sensors as in")));
}

TEST(Sensors, ReportTheSignalsOfASimulatedRun) {
  const ScratchFolder folder;
  folder.write("lossy.yaml", "records: {dropout: {rate: 2.0, length: 0.003}}\n");
  const auto simulated = [&](const std::string& name, const std::string& flags) {
    const Ended ended = touchdown_program(
        "simulate drawn:hops_7_000 --run 2 --set end.duration=1.5 -o " + name + ".mpack " + flags,
        folder.path());
    EXPECT_EQ(ended.exit_code, 0) << ended.errors;
    return logs::read_recording(folder / (name + ".mpack"));
  };
  const logs::Recording ideal = simulated("none", "");
  EXPECT_EQ(simulated("ideal", "--sensors noise/profiles/ideal.yaml").steps(), ideal.steps());
  EXPECT_EQ(read_file(folder / "ideal.mpack"), read_file(folder / "none.mpack"));

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
  EXPECT_EQ(read_file(folder / "again.mpack"), read_file(folder / "upkie.mpack"));

  const Ended missing = touchdown_program(
      "simulate scenarios/flat.yaml -o x.mpack --sensors noise/profiles/upkei.yaml", folder.path());
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_THAT(missing.errors, HasSubstr("noise/profiles/upkei.yaml: no such file (did you mean"));
}

TEST(Sensors, ChangeSignalsAndFitsButNotRecordings) {
  const ScratchFolder folder;
  write_tiny_experiment(folder);
  const auto none = run_with(folder, "none");
  const auto harsh = run_with(folder, "harsh", "--set sensors=noise/profiles/harsh.yaml");
  const auto different = different_files(none, harsh);
  EXPECT_THAT(different, Each(Not(StartsWith("recordings/"))));
  for (const char* name : {"tables/success.csv", "tables/latency.csv", "models/mujoco_robust.npz",
                           "models/bullet_robust.npz", "config.yaml"}) {
    EXPECT_THAT(different, Contains(name));
  }
  EXPECT_THAT(read_file(folder / "harsh/config.yaml"),
              HasSubstr("sensors: noise/profiles/harsh.yaml"));
  EXPECT_THAT(read_file(folder / "harsh/tables/tables.md"),
              HasSubstr("sensors as in noise/profiles/harsh.yaml"));
  EXPECT_THAT(read_file(folder / "harsh/tables/success.csv"), Not(HasSubstr("nan,nan")));
}

TEST(Sensors, GiveTheSameBytesAgainWhateverTheNumberOfThreadsAndTheEngines) {
  const ScratchFolder folder;
  write_tiny_experiment(folder);
  const std::string harsh = "--set sensors=noise/profiles/harsh.yaml --set workers=";
  const auto first = run_with(folder, "a", harsh + "4");
  EXPECT_THAT(different_files(first, run_with(folder, "b", harsh + "1")), IsEmpty());
  const auto mujoco = run_with(folder, "c", harsh + "2 --set simulators=[mujoco]");
  for (const char* same : {"models/mujoco_robust.npz", "recordings/mujoco_step_test_001.mpack"}) {
    EXPECT_EQ(mujoco.at(same), first.at(same)) << same;
  }
}

TEST(Sensors, OfAProfileThatWasEditedAreAnotherRequest) {
  const ScratchFolder folder;
  write_tiny_experiment(folder);
  folder.write("mine.yaml", "# Mine.\ntorque: {white: 0.1}\n");
  const std::string run = "run tiny.yaml --out a --set sensors=mine.yaml";
  ASSERT_EQ(touchdown_program(run, folder.path()).exit_code, 0);
  folder.write("mine.yaml", "# Mine, and better documented.\ntorque: {white: 0.1}\n");
  EXPECT_EQ(touchdown_program(run, folder.path()).exit_code, 0);
  folder.write("mine.yaml", "torque: {white: 0.2}\n");
  const Ended other = touchdown_program(run, folder.path());
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.errors, HasSubstr("holds experiment 'tiny'"));
  // A merge uses the profile of the run, not the edited file.
  const Ended merged = touchdown_program("merge a", folder.path());
  EXPECT_EQ(merged.exit_code, 0) << merged.errors;
}

TEST(Sensors, OfAProfileThatIsWrongStopTheRunBeforeItBegins) {
  const ScratchFolder folder;
  write_tiny_experiment(folder);
  folder.write("mine.yaml", "torque:\n  delay: -0.001\n");
  const auto complaint = [&](const std::string& file) {
    const Ended ended =
        touchdown_program("run tiny.yaml --out a --set sensors=" + file, folder.path());
    EXPECT_EQ(ended.exit_code, 2);
    EXPECT_EQ(std::count(ended.errors.begin(), ended.errors.end(), '\n'), 1) << ended.errors;
    EXPECT_FALSE(std::filesystem::exists(folder / "a"));
    return ended.errors;
  };
  EXPECT_THAT(complaint("mine.yaml"),
              HasSubstr("mine.yaml:2:10: torque.delay: expected a number from 0 to 10"));
  EXPECT_THAT(complaint("noise/profiles/upkei.yaml"),
              AllOf(HasSubstr("noise/profiles/upkei.yaml: no such file"),
                    HasSubstr("did you mean 'noise/profiles/upkie.yaml'?")));
}

TEST(Sensors, AreListedWithADescription) {
  const ScratchFolder folder;
  const Ended listed = touchdown_program("list", folder.path());
  EXPECT_THAT(listed.output, HasSubstr("noise/profiles/upkie.yaml   Upkie: servos by moteus"));
  EXPECT_THAT(listed.output, HasSubstr("noise/profiles/harsh.yaml"));
}

}  // namespace
}  // namespace touchdown::cli
