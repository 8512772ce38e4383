#include <chrono>
#include <csignal>
#include <filesystem>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.hpp"
#include "result_files.hpp"

namespace touchdown::cli {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

namespace fs = std::filesystem;

/// A folder with a recording, `a.mpack`.
class Render : public InFolder {
 protected:
  void SetUp() override {
    write_tiny_experiment(folder_);
    folder_.output_of("simulate step.yaml -o a.mpack");
  }

  /// Flags of a run whose films last half a second.
  std::string half_a_second() const {
    std::string scene = folder_.text("step.yaml");
    scene.replace(scene.find("name: step"), 10, "name: half");
    folder_.write("half.yaml", scene.replace(scene.find("duration: 2.5"), 13, "duration: 0.5"));
    return " --set test.scenarios=[half.yaml]";
  }

  std::string render(const std::string& arguments) const {
    return folder_.output_of("render " + arguments + " --width 320 --height 180 --fps 10 ");
  }
};

TEST_F(Render, FilmsASegmentInSlowMotionAndTwoRecordingsSideBySide) {
  EXPECT_THAT(render("a.mpack -o x.mp4 --from 0.5 --to 1 --speed 0.25"),
              HasSubstr("x.mp4: 21 frames"));
  EXPECT_EQ(folder_.text("x.mp4").substr(4, 4), "ftyp");
  EXPECT_THAT(render("a.mpack a.mpack -o y.mp4 --layout side-by-side --to 0.5"),
              HasSubstr("6 frames"));
}

TEST_F(Render, MakesPosters) {
  render("a.mpack -o x.png --poster");
  render("a.mpack -o x.jpg --poster --from 1");
  render("a.mpack -o scene.png --scene");
  EXPECT_EQ(folder_.text("x.png").substr(1, 3), "PNG");
  EXPECT_EQ(folder_.text("x.jpg").substr(0, 2), "\xff\xd8");
  EXPECT_EQ(folder_.text("scene.png").substr(1, 3), "PNG");
  EXPECT_NE(folder_.text("scene.png"), folder_.text("x.png"));
}

TEST_F(Render, ShowsTheRobotWithItsDeviations) {
  // Wheels of twice the size, once by the robot's file and once by a deviation, give the same
  // picture.
  write_atomically(folder_ / "large.yaml",
                   "mjcf: " TOUCHDOWN_SOURCE_DIR "/models/upkie.xml\nwheel_radius: 0.1\n");
  for (const char* arguments : {"-o plain.mpack", "--set robot=large.yaml -o file.mpack",
                                "--set deviations.wheel_radius_scale=2 -o drawn.mpack"}) {
    folder_.output_of(std::string("simulate step.yaml --set end.duration=0.01 ") + arguments);
  }
  for (const char* name : {"plain", "file", "drawn"}) {
    render(fmt::format("{0}.mpack -o {0}.png --poster --scene --from 0", name));
  }
  EXPECT_EQ(folder_.text("drawn.png"), folder_.text("file.png"));
  EXPECT_NE(folder_.text("drawn.png"), folder_.text("plain.png"));
}

TEST_F(Render, FilmsRunDirectoriesAndReportsThemAgain) {
  folder_.output_of(
      "run tiny.yaml --out run --no-pictures --set video.enabled=true --set video.run=1 "
      "--set test.runs=2");
  EXPECT_FALSE(folder_.has("run/report.html"));
  render("run -o x.mp4 --layout side-by-side --to 0.5");
  render("run -o y.mp4 --to 0.5");
  folder_.output_of("report run --no-video --no-replay");
  EXPECT_THAT(folder_.text("run/report.html"),
              AllOf(HasSubstr("Bayes filter (robust)"), HasSubstr("touchdown run"),
                    Not(HasSubstr("<video"))));
}

/// One pass paints all films of a run; the report's film alone has the same bytes.
TEST_F(Render, FilmsOfARunAreMadeOnRequest) {
  const auto page = [&] { return folder_.text("run/report.html"); };
  const std::string half = half_a_second();
  folder_.output_of("run tiny.yaml --out run --no-video --set video.enabled=true" + half);
  EXPECT_FALSE(folder_.has("run/videos/report.mp4"));
  EXPECT_THAT(page(), AllOf(Not(HasSubstr("<video")), HasSubstr("class=\"replay\"")));
  EXPECT_TRUE(folder_.has("run/figures"));

  folder_.output_of("report run");
  const std::string alone = folder_.text("run/videos/report.mp4");
  EXPECT_THAT(page(), HasSubstr("<video"));
  EXPECT_FALSE(folder_.has("run/videos/mujoco_half.mp4"));

  folder_.output_of("run tiny.yaml --out run --set video.enabled=true" + half);
  EXPECT_TRUE(folder_.text("run/videos/report.mp4") == alone);
  EXPECT_TRUE(folder_.has("run/videos/mujoco_half.mp4"));

  // A film that is newer than the run's recordings and models is not painted again.
  const fs::file_time_type now = fs::file_time_type::clock::now();
  const auto set_age = [&](const fs::path& file, int hours) {
    fs::last_write_time(file, now - std::chrono::hours(hours));
  };
  const auto film = folder_ / "run/videos/report.mp4";
  for (const std::string kept : {"recordings", "models"}) {
    fs::path one;
    for (const char* folder : {"recordings", "models"}) {
      for (const auto& file : fs::directory_iterator(folder_ / "run" / folder)) {
        set_age(file, 5);
        if (folder == kept) one = file;
      }
    }
    set_age(film, 3);
    set_age(folder_ / "run/videos/report.jpg", 3);
    folder_.output_of("report run --no-replay");
    EXPECT_EQ(fs::last_write_time(film), now - std::chrono::hours(3));
    EXPECT_THAT(page(), Not(HasSubstr("class=\"replay\"")));
    set_age(one, 2);
    folder_.output_of("report run");
    EXPECT_GT(fs::last_write_time(film), now - std::chrono::hours(1)) << kept;
    EXPECT_TRUE(read_file(film) == alone);
  }
}

/// The bytes of `content` with every `from` replaced by a `to` of the same length.
std::string altered(std::string content, const std::string& from, const std::string& to) {
  EXPECT_EQ(from.size(), to.size());
  std::size_t at = content.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  for (; at != std::string::npos; at = content.find(from, at + to.size())) {
    content.replace(at, from.size(), to);
  }
  return content;
}

TEST_F(Render, RefusesWrongRequestsInOneLineBeforeAnythingIsDrawn) {
  const std::string log = folder_.text("a.mpack");
  folder_.write("cut.mpack", log.substr(0, 100));
  folder_.write("joints.mpack", altered(log, "left_knee", "left_elbw"));
  folder_.write("model.mpack", altered(log, "upkie.xml", "other.xml"));
  folder_.write("real.mpack", altered(log, "touchdown", "something"));  // it has no terrain
  fs::create_directory(folder_ / "folder.mp4");
  folder_.expect_refusals({{"render b.mpack -o x.mp4", {"b.mpack"}},
                           {"render a.mpack -o x.mp4 --spede 2", {"'--speed'"}},
                           {"render a.mpack -o x.mp4 --quality best", {"draft"}},
                           {"render a.mpack -o x.mp4 --from 2 --to 1", {"from 2 s to 1 s"}},
                           {"render a.mpack -o x.mp4 --from 100", {"2.5"}},
                           {"render a.mpack -o x.mp4 --speed 0", {"speed"}},
                           {"render a.mpack -o x.mp4 --layout side-by-side", {"two runs"}},
                           {"render a.mpack a.mpack -o x.mp4 --layout single", {"one run"}},
                           {"render . -o x.mp4", {"no run directory"}},
                           {"render a.mpack -o new", {".mp4"}},
                           {"render joints.mpack -o x.mp4", {"joints.mpack", "left_knee"}},
                           {"render model.mpack -o x.mp4", {"other.xml"}},
                           {"render real.mpack -o x.mp4", {"terrain"}},
                           {"report .", {"no run directory"}}});
  EXPECT_EQ(folder_.run("render cut.mpack -o x.mp4").exit_code, 2);
  EXPECT_THAT(folder_.text(".stderr"), HasSubstr("cut.mpack"));
  folder_.expect_refusals({{"render a.mpack -o a.mpack/x.mp4", {"cannot be written"}},
                           {"render a.mpack -o a.mpack/x.png --poster", {"cannot be written"}},
                           {"render a.mpack -o folder.mp4", {"cannot be written"}},
                           {"render a.mpack -o .", {".: cannot be written: it is a folder"}}},
                          1);
  EXPECT_FALSE(folder_.has("x.mp4"));
}

/// Live children of `parent`, by /proc: zombies do not count.
std::set<pid_t> children_of(pid_t parent) {
  std::set<pid_t> children;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const std::string name = entry.path().filename().string();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    try {
      const std::string stat = read_file(entry.path() / "stat");
      const std::string fields = stat.substr(stat.rfind(')') + 2);
      if (fields[0] != 'Z' && std::stol(fields.substr(2)) == parent)
        children.insert(std::stoi(name));
    } catch (const std::exception&) {
      continue;  // gone meanwhile
    }
  }
  return children;
}

bool is_alive(pid_t process) {
  try {
    const std::string stat = read_file("/proc/" + std::to_string(process) + "/stat");
    return stat[stat.rfind(')') + 2] != 'Z';
  } catch (const std::exception&) {
    return false;
  }
}

class Interrupted : public Render, public ::testing::WithParamInterface<int> {};

INSTANTIATE_TEST_SUITE_P(Signals, Interrupted, ::testing::Values(SIGINT, SIGTERM, SIGKILL),
                         [](const auto& signal) -> std::string {
                           return signal.param == SIGINT    ? "Interrupt"
                                  : signal.param == SIGTERM ? "Terminate"
                                                            : "Kill";
                         });

TEST_P(Interrupted, LeavesNoProcessNoSharedMemoryAndNoPartialFile) {
  const std::set<std::string> before = names_in(folder_.path());
  StartedProgram program("render a.mpack -o x.mp4 --speed 0.001 --workers 2", folder_.path());
  std::set<pid_t> workers;
  for (int i = 0; i < 3000 && workers.size() < 2; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    workers = children_of(program.process());
  }
  ASSERT_EQ(workers.size(), 2U);
  program.send(GetParam());
  EXPECT_NE(program.end().exit_code, 0);
  for (const pid_t worker : workers) {
    for (int i = 0; i < 3000 && is_alive(worker); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    EXPECT_FALSE(is_alive(worker));
  }
  std::set<std::string> after = names_in(folder_.path());
  for (const char* stream : {".started.stdout", ".started.stderr"}) after.erase(stream);
  EXPECT_EQ(after, before);
  // The memory that the program shares with its workers is anonymous. A named segment would be
  // here.
  for (const auto& entry : fs::directory_iterator("/dev/shm")) {
    if (entry.is_directory()) continue;  // a test's scratch folder
    EXPECT_EQ(entry.path().filename().string().find("touchdown"), std::string::npos) << entry;
  }
}

}  // namespace
}  // namespace touchdown::cli
