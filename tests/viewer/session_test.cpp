#include <algorithm>
#include <array>
#include <cstdlib>
#include <sys/wait.h>

#include <fmt/format.h>
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

bool has_display_tools() {
  return std::system("command -v Xvfb xdotool ffmpeg >/dev/null 2>&1") == 0;
}

/// Runs the viewer on a display of its own while `script` uses keys and mouse.
int watch(const ScratchFolder& folder, const std::string& script, const std::string& arguments,
          const std::string& size = "--width 900 --height 640") {
  return shell(folder, "tests/viewer/on_display.sh '" + script + "' " TOUCHDOWN_WATCH " " +
                           arguments + " " + size);
}

std::string quoted(const std::filesystem::path& path) { return "'" + path.string() + "'"; }

TEST(WatchSession, LiftsDrivesAndSwitchesAndTheRecordingsRepeat) {
  if (!has_display_tools()) GTEST_SKIP() << "needs the packages xvfb, xdotool and ffmpeg";
  const ScratchFolder folder;
  const std::string script =
      "sleep 2; xdotool mousemove 309 155 mousedown 1; "  // the torso, at rest
      "for i in $(seq 15); do xdotool mousemove_relative -- 0 -8; sleep 0.1; done; sleep 0.5; "
      "xdotool mouseup 1; sleep 0.5; xdotool key r; sleep 1; "
      "xdotool key h; sleep 0.5; xdotool key h; "
      "xdotool key t t p o o b; "  // noise, sensors; the policy gets the load filter's contact
      "xdotool key Up Up Left; sleep 2; xdotool key c j; sleep 1.5; xdotool key v v v v; "
      "sleep 0.5; xdotool key e; sleep 2; xdotool key Up Up Up; sleep 2; xdotool key space; "
      "sleep 0.5; xdotool key period period; sleep 0.5; xdotool key q";
  const auto lifted = folder / "run.mpack";
  const auto driven = folder / "run_2.mpack";
  const auto in_bullet = folder / "run_3.mpack";
  ASSERT_EQ(watch(folder, script,
                  "scenarios/flat.yaml --estimator load_filter --estimator free_fall "
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

/// The pixels of a colour (0xRRGGBB) in columns and rows [begin, end) of the window's picture.
int pixels_of(const std::string& picture, unsigned colour, std::array<std::size_t, 2> columns,
              std::array<std::size_t, 2> rows) {
  constexpr std::size_t width = 900;
  int count = 0;
  for (std::size_t y = rows[0]; y < rows[1]; ++y) {
    for (std::size_t x = columns[0]; x < columns[1]; ++x) {
      unsigned pixel = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        pixel = 256 * pixel + static_cast<unsigned char>(picture.at(3 * (y * width + x) + i));
      }
      if (pixel == colour) ++count;
    }
  }
  return count;
}

/// MuJoCo and the widgets share an OpenGL context, in which each must find its own state again.
TEST(WatchSession, DrawsPanelAndPlotsBesideTheSceneAndTheMouseSetsASlider) {
  if (!has_display_tools()) GTEST_SKIP() << "needs the packages xvfb, xdotool and ffmpeg";
  const ScratchFolder folder;
  const auto file = folder / "picture.rgb";
  const std::string script =
      "until_shown 787 280 0072b2; xdotool mousemove 825 284 mousedown 1; sleep 0.3; "
      "xdotool mousemove 860 284; until_shown 858 280 789cde; "  // the handle below the mouse
      "xdotool mouseup 1 mousemove 300 350; until_shown 858 280 0072b2; picture 900x640 0 0 > " +
      file.string() + "; xdotool key q";
  ASSERT_EQ(watch(folder, script, "scenarios/flat.yaml"), 0) << text(folder, "err");
  const std::string picture = read_file(file);
  EXPECT_GT(pixels_of(picture, 0x2f8f5b, {600, 900}, {0, 400}), 500) << "contact of both wheels";
  EXPECT_GT(pixels_of(picture, 0xcfe8d2, {0, 900}, {410, 640}), 5000) << "bands of contact";
  EXPECT_GT(pixels_of(picture, 0x0072b2, {850, 870}, {274, 294}), 40) << "the slider's handle";
  EXPECT_EQ(pixels_of(picture, 0xf7f8fa, {200, 400}, {100, 300}), 0) << "the robot";
}

TEST(WatchSession, PlaysARecordingToAnErrorAndBack) {
  if (!has_display_tools()) GTEST_SKIP() << "needs the packages xvfb, xdotool and ffmpeg";
  const ScratchFolder folder;
  ASSERT_EQ(
      shell(folder, TOUCHDOWN_PROGRAM " simulate scenarios/one_step.yaml --set end.duration=4 -o " +
                        quoted(folder / "run.mpack")),
      0)
      << text(folder, "err");
  const std::string script =
      "xdotool key o e e shift+e t shift+t; sleep 0.5; xdotool key space f f Home; "
      "sleep 0.5; xdotool mousemove 450 420 click 1; sleep 0.5; xdotool key h v comma period End; "
      "sleep 0.5; xdotool key q";
  EXPECT_EQ(watch(folder, script, quoted(folder / "run.mpack")), 0) << text(folder, "err");
  EXPECT_EQ(text(folder, "err"), "");
}

/// A robot's log of two seconds.
std::filesystem::path robot_log(const ScratchFolder& folder) {
  const auto path = folder / "robot.mpack";
  EXPECT_EQ(
      shell(folder, TOUCHDOWN_PROGRAM " simulate scenarios/flat.yaml --set end.duration=2 -o " +
                        quoted(path)),
      0)
      << text(folder, "err");
  logs::Recording log = logs::read_recording(path);
  log.truth.clear();
  log.info = {};  // its steps are of a millisecond
  logs::write_recording(log, path);
  return path;
}

TEST(WatchSession, EditsLabelsByKeysAndSavesEachEdit) {
  if (!has_display_tools()) GTEST_SKIP() << "needs the packages xvfb, xdotool and ffmpeg";
  const ScratchFolder folder;
  const auto labels = folder.write("labels.csv",
                                   "start,end,left,right,sure\n"
                                   "0,1,1,1,0.9\n1,1.5,0,0,0.6\n1.5,2,1,1,0.8\n");
  const std::string script =
      "xdotool key n k equal equal shift+equal Return; "  // 12 steps later, accepted
      "until_written " +
      labels.string() + " 1,1.5,0,0,1.000; cp " + labels.string() + " " +
      (folder / "half.csv").string() +
      "; "
      "xdotool key shift+a u x u; "           // both undone
      "xdotool key Home b Right a k minus; "  // 0 to 0.1 s, then one step less
      "xdotool key w k k i shift+u; sleep 0.5; xdotool key q";
  ASSERT_EQ(watch(folder, script, quoted(robot_log(folder)) + " --labels " + quoted(labels)), 0)
      << text(folder, "err");
  EXPECT_EQ(text(folder, "half.csv"),
            "start,end,left,right,sure\n0,1,1,1,0.900\n1,1.5,0,0,1.000\n1.5,1.512,0,1,1.000\n"
            "1.512,2,1,1,0.800\n");
  EXPECT_EQ(read_file(labels),
            "start,end,left,right,sure\n0,0.099,0,1,1.000\n0.099,1,1,1,0.900\n"
            "1,1.5,0,0,1.000\n1.5,1.512,0,1,1.000\n1.512,2,1,1,0.800\n");
  EXPECT_THAT(text(folder, "out"), HasSubstr("6 edits saved; 5 intervals, 2.000 s, 2 to look at"));
}

TEST(WatchSession, BeginsAFileOfLabelsAndDragsAnEdge) {
  if (!has_display_tools()) GTEST_SKIP() << "needs the packages xvfb, xdotool and ffmpeg";
  const ScratchFolder folder;
  const auto labels = folder / "new.csv";
  // 1 s marked from the start; its end is in the middle of the plots, 108 px are 0.4 s.
  const std::string script =
      "xdotool key period Home b shift+Right c; sleep 0.3; "
      "xdotool mousemove 716 438 mousedown 1; sleep 0.3; xdotool mousemove 770 438; sleep 0.3; "
      "xdotool mousemove 824 438; sleep 0.3; xdotool mouseup 1; sleep 0.5; xdotool key q";
  ASSERT_EQ(watch(folder, script, quoted(robot_log(folder)) + " --labels " + quoted(labels), ""), 0)
      << text(folder, "err");
  EXPECT_EQ(read_file(labels), "start,end,left,right\n0,1.4,1,1\n");
  EXPECT_THAT(text(folder, "out"), HasSubstr("2 edits saved; 1 interval, "));
}

/// A log in another layout, and from a bag's clock, is labelled by its mapping.
TEST(WatchSession, EditsLabelsOfALogThatIsReadByItsMapping) {
  if (!has_display_tools()) GTEST_SKIP() << "needs the packages xvfb, xdotool and ffmpeg";
  const ScratchFolder folder;
  const logs::Recording log = logs::read_recording(robot_log(folder));
  std::string csv = "stamp";
  for (const char* signal : {"p", "v", "t"}) {
    for (int i = 0; i < 6; ++i) csv += fmt::format(",{}{}", signal, i);
  }
  csv += ",qw,qx,qy,qz,gx,gy,gz,ax,ay,az\n";
  for (std::size_t k = 0; k < log.steps(); ++k) {
    const models::Observation& o = log.observation[k];
    csv += fmt::format("{:.3f}", 81000.0 + 0.001 * static_cast<double>(k));
    for (const auto& servo : o.servo) csv += fmt::format(",{}", servo.position);
    for (const auto& servo : o.servo) csv += fmt::format(",{}", servo.velocity);
    for (const auto& servo : o.servo) csv += fmt::format(",{}", servo.torque);
    const auto& imu = o.imu;
    const auto& q = imu.orientation;
    csv += fmt::format(",{},{},{},{},{},{},{},{},{},{}\n", q.w(), q.x(), q.y(), q.z(),
                       imu.angular_velocity.x(), imu.angular_velocity.y(), imu.angular_velocity.z(),
                       imu.raw_linear_acceleration.x(), imu.raw_linear_acceleration.y(),
                       imu.raw_linear_acceleration.z());
  }
  const auto table = folder.write("robot.csv", csv);
  const auto mapping = folder.write(
      "robot.yaml",
      "time: {from: stamp}\n"
      "joints: {position: {from: [p0, p1, p2, p3, p4, p5]}, velocity: {from: [v0, v1, v2, v3, v4, "
      "v5]}, torque: {from: [t0, t1, t2, t3, t4, t5]}}\n"
      "imu: {axes: [x, y, z], orientation: {from: [qw, qx, qy, qz], order: wxyz}, "
      "angular_velocity: {from: [gx, gy, gz]}, proper_acceleration: {from: [ax, ay, az]}}\n");
  const auto labels = folder / "labels.csv";
  const std::string arguments = quoted(table) + " --mapping " + quoted(mapping);
  ASSERT_EQ(
      shell(folder, TOUCHDOWN_PROGRAM " estimate " + arguments + " --propose " + quoted(labels)), 0)
      << text(folder, "err");
  EXPECT_THAT(text(folder, "out"),
              HasSubstr("touchdown estimate " + table.string() + " --labels " + labels.string() +
                        " --mapping " + mapping.string() + "\n"));
  EXPECT_TRUE(read_file(labels).starts_with("start,end,left,right,sure\n0,2.001,1,1,"))
      << read_file(labels);
  const std::string script = "xdotool key n Return; sleep 0.5; xdotool key q";
  ASSERT_EQ(watch(folder, script, arguments + " --labels " + quoted(labels)), 0)
      << text(folder, "err");
  EXPECT_THAT(text(folder, "out"), HasSubstr("1 edit saved; 1 interval, 2.001 s, 0 to look at"));
  EXPECT_EQ(read_file(labels), "start,end,left,right\n0,2.001,1,1\n");
}

TEST(WatchSession, ShowsAFilmWithAnOffsetToTypeNextTime) {
  if (!has_display_tools()) GTEST_SKIP() << "needs the packages xvfb, xdotool and ffmpeg";
  const ScratchFolder folder;
  const auto log = folder / "run.mpack";
  const auto film = folder / "film.mp4";
  ASSERT_EQ(
      shell(folder, TOUCHDOWN_PROGRAM " simulate scenarios/flat.yaml --set end.duration=2 -o " +
                        quoted(log)),
      0);
  ASSERT_EQ(shell(folder, TOUCHDOWN_PROGRAM " render " + quoted(log) + " --to 1 -o " +
                              quoted(film) + " --width 320 --height 240"),
            0)
      << text(folder, "err");
  const std::string script =
      "xdotool key bracketright bracketright shift+bracketleft; sleep 0.5; "
      "xdotool key End Home t; sleep 0.5; xdotool key q";
  ASSERT_EQ(watch(folder, script, quoted(log) + " --film " + quoted(film) + " --film-offset 0.5"),
            0)
      << text(folder, "err");
  EXPECT_EQ(text(folder, "out"), fmt::format("--film-offset {:.4f}\n", 0.5 - 8.0 / 30.0));
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
  const std::string log = quoted(robot_log(folder));
  const auto bad_labels = folder.write("labels.csv", "start,end,contact\n0,soon,1\n");
  const auto milliseconds = folder.write("ms.csv", "start,end,contact\n0,1000,1\n1000,2000,0\n");
  const auto frames = folder.write("frames.csv", "start,end,left,right\n0,30,1,1\n30,60,1,0\n");
  for (const Case& one :
       std::vector<Case>{{quoted(folder / "notes.txt"), "expected a scenario"},
                         {"scenarios/stairz.yaml", "stairs.yaml"},
                         {"models/upkee.xml", "upkie.xml"},
                         {"experiments/stairs.yaml", "an experiment"},
                         {quoted(folder / "empty.mpack"), "empty.mpack"},
                         {"scenarios/flat.yaml --estimator lode_filter", "load_filter"},
                         {"scenarios/flat.yaml --estimator robust", "robust=MODEL.npz"},
                         {"scenarios/flat.yaml --estimator oracle", "oracle"},
                         {"scenarios/flat.yaml --simulator bulet", "bulet"},
                         {"scenarios/flat.yaml --set end.durations=3", "duration"},
                         {"scenarios/flat.yaml --record run.txt", ".mpack"},
                         {quoted(folder.path()), "config.yaml"},
                         {"scenarios/flat.yaml --labels l.csv", "expected a log"},
                         {"scenarios/flat.yaml --film notes.mp4", "expected a log"},
                         {log + " --labels l.txt", ".csv"},
                         {log + " --labels " + quoted(bad_labels), "labels.csv:2:"},
                         {log + " --labels " + quoted(milliseconds), "expected seconds"},
                         {log + " --labels " + quoted(frames), "another unit, or another log's"},
                         {log + " --film " + quoted(folder / "notes.txt"), "expected a film"},
                         {log + " --film none.mp4", "there is no file 'none.mp4'"}}) {
    EXPECT_EQ(
        shell(folder, "env -u DISPLAY -u WAYLAND_DISPLAY " TOUCHDOWN_WATCH " " + one.arguments), 2)
        << one.arguments << "\n"
        << text(folder, "err");
    EXPECT_THAT(text(folder, "err"), HasSubstr(one.message)) << one.arguments;
    const std::string message = text(folder, "err");
    EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 1) << message;
  }
}

}  // namespace
}  // namespace touchdown::viewer
