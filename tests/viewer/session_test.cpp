#include <algorithm>
#include <cstdlib>
#include <sys/wait.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "logs/log/recording_file.hpp"
#include "scenarios/scenario.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::viewer {
namespace {

using ::testing::HasSubstr;

/// The exit code of a shell command. Its output goes into files of the folder.
int shell(const ScratchFolder& folder, const std::string& command) {
  const std::string line = "cd '" TOUCHDOWN_SOURCE_DIR "' && { " + command + "; } >'" +
                           (folder / "out").string() + "' 2>'" + (folder / "err").string() + "'";
  const int status = std::system(line.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string text(const ScratchFolder& folder, const std::string& name) {
  return read_file(folder / name);
}

bool has_display_tools() { return std::system("command -v Xvfb xdotool >/dev/null 2>&1") == 0; }

/// Runs the viewer on a display of its own while `script` uses keys and mouse.
int watch(const ScratchFolder& folder, const std::string& script, const std::string& arguments) {
  return shell(folder, "tests/viewer/on_display.sh '" + script + "' " TOUCHDOWN_WATCH " " +
                           arguments + " --width 900 --height 640");
}

std::string quoted(const std::filesystem::path& path) { return "'" + path.string() + "'"; }

TEST(WatchSession, LiftsDrivesAndSwitchesAndTheRecordingsRepeat) {
  if (!has_display_tools()) GTEST_SKIP() << "needs the packages xvfb and xdotool";
  const ScratchFolder folder;
  const std::string script =
      "sleep 2; xdotool mousemove 349 155 mousedown 1; "  // the torso
      "for i in $(seq 15); do xdotool mousemove_relative -- 0 -8; sleep 0.1; done; sleep 0.5; "
      "xdotool mouseup 1; sleep 0.5; xdotool key r; sleep 1; "
      "xdotool key h; sleep 0.5; xdotool key h; "
      "xdotool key t t p o o b; "  // noise, sensors; the policy gets the shipped model's contact
      "xdotool key Up Up Left; sleep 2; xdotool key c j; sleep 1.5; xdotool key v v v v; "
      "sleep 0.5; xdotool key e; sleep 2; xdotool key Up Up Up; sleep 2; xdotool key space; "
      "sleep 0.5; xdotool key period period; sleep 0.5; xdotool key q";
  const auto lifted = folder / "run.mpack";
  const auto driven = folder / "run_2.mpack";
  const auto in_bullet = folder / "run_3.mpack";
  ASSERT_EQ(watch(folder, script,
                  "scenarios/flat.yaml --estimator shipped --estimator support_force "
                  "--record " +
                      quoted(lifted)),
            0)
      << text(folder, "err");
  const auto scenario_of = [](const logs::Recording& recording) {
    return scenarios::scenario_from_yaml(
        YamlDocument::parse(recording.info.scenario_yaml, recording.info.scenario));
  };

  const logs::Recording lift = logs::read_recording(lifted);
  double highest = 0.0;
  for (const models::GroundTruth& truth : lift.truth) {
    highest = std::max(highest, truth.base_position.z());
  }
  EXPECT_GT(highest, lift.truth.front().base_position.z() + 0.1) << "the drag did not lift";
  EXPECT_FALSE(scenario_of(lift).forces.empty());
  const scenarios::Scenario drive = scenario_of(logs::read_recording(driven));
  EXPECT_FALSE(drive.velocity.empty()) << "no drive";
  EXPECT_FALSE(drive.crouch.empty()) << "no crouch and no hop";
  EXPECT_FALSE(drive.policy.contact_script.empty()) << "no contact of an estimator";
  EXPECT_EQ(logs::read_recording(driven).info.simulator, "mujoco");
  EXPECT_EQ(logs::read_recording(in_bullet).info.simulator, "bullet");

  for (const auto& path : {lifted, driven, in_bullet}) {
    EXPECT_THAT(text(folder, "out"), HasSubstr(path.string()));
  }
  for (const auto& path : {lifted, driven, in_bullet}) {
    const auto again = folder / "again.mpack";
    ASSERT_EQ(shell(folder, TOUCHDOWN_PROGRAM " simulate " + quoted(path) + " -o " + quoted(again)),
              0)
        << text(folder, "err");
    EXPECT_EQ(read_file(path), read_file(again)) << path;
  }
}

TEST(WatchSession, PlaysARecordingToAnErrorAndBack) {
  if (!has_display_tools()) GTEST_SKIP() << "needs the packages xvfb and xdotool";
  const ScratchFolder folder;
  ASSERT_EQ(
      shell(folder, TOUCHDOWN_PROGRAM " simulate scenarios/one_step.yaml --set end.duration=4 -o " +
                        quoted(folder / "run.mpack")),
      0)
      << text(folder, "err");
  const std::string script =
      "sleep 1; xdotool key o e e shift+e t shift+t; sleep 0.5; xdotool key space f f Home; "
      "sleep 0.5; xdotool mousemove 450 420 click 1; sleep 0.5; xdotool key h v comma period End; "
      "sleep 0.5; xdotool key q";
  EXPECT_EQ(watch(folder, script, quoted(folder / "run.mpack")), 0) << text(folder, "err");
  EXPECT_EQ(text(folder, "err"), "");
}

TEST(WatchSession, PointsToRenderWithoutADisplay) {
  const ScratchFolder folder;
  EXPECT_EQ(shell(folder, "env -u DISPLAY -u WAYLAND_DISPLAY " TOUCHDOWN_PROGRAM
                          " watch scenarios/flat.yaml"),
            1);
  const std::string message = text(folder, "err");
  EXPECT_THAT(message, HasSubstr("touchdown render"));
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 1) << message;
}

TEST(WatchSession, RefusesWhatCannotBeWatched) {
  const ScratchFolder folder;
  struct Case {
    std::string arguments, message;
  };
  folder.write("notes.txt", "hello");
  folder.write("empty.mpack", "");
  for (const Case& one :
       std::vector<Case>{{quoted(folder / "notes.txt"), "expected a scenario"},
                         {"scenarios/stairz.yaml", "stairs.yaml"},
                         {"models/upkee.xml", "upkie.xml"},
                         {"experiments/stairs.yaml", "an experiment"},
                         {quoted(folder / "empty.mpack"), "empty.mpack"},
                         {"scenarios/flat.yaml --estimator evidence_curvs", "evidence_curves"},
                         {"scenarios/flat.yaml --estimator robust", "--model"},
                         {"scenarios/flat.yaml --estimator oracle", "oracle"},
                         {"scenarios/flat.yaml --simulator bulet", "bulet"},
                         {"scenarios/flat.yaml --set end.durations=3", "duration"},
                         {"scenarios/flat.yaml --record run.txt", ".mpack"},
                         {quoted(folder.path()), "config.yaml"}}) {
    EXPECT_EQ(
        shell(folder, "env -u DISPLAY -u WAYLAND_DISPLAY " TOUCHDOWN_WATCH " " + one.arguments), 2)
        << one.arguments << "\n"
        << text(folder, "err");
    EXPECT_THAT(text(folder, "err"), HasSubstr(one.message)) << one.arguments;
  }
}

}  // namespace
}  // namespace touchdown::viewer
