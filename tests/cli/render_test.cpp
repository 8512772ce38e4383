#include <algorithm>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <set>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "program.hpp"
#include "tests/cli/result_files.hpp"

namespace touchdown::cli {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

namespace fs = std::filesystem;

constexpr const char* small_film = " --width 320 --height 180 --fps 10 ";

/// A folder with a recording, `a.mpack`.
class Render : public ::testing::Test {
 protected:
  void SetUp() override {
    write_tiny_experiment(folder_);
    const Ended ended = touchdown_program("simulate step.yaml -o a.mpack", folder_.path());
    ASSERT_EQ(ended.exit_code, 0) << ended.errors;
  }

  std::string complaint_about(const std::string& arguments, int exit_code) const {
    const Ended ended = touchdown_program("render " + arguments, folder_.path());
    EXPECT_EQ(ended.exit_code, exit_code) << arguments << ": " << ended.errors;
    EXPECT_FALSE(fs::exists(folder_ / "x.mp4"));
    return ended.errors;
  }

  Ended render(const std::string& arguments) const {
    return touchdown_program("render " + arguments + small_film, folder_.path());
  }

  const ScratchFolder folder_;
};

TEST_F(Render, FilmsASegmentInSlowMotion) {
  const Ended ended = render("a.mpack -o x.mp4 --from 0.5 --to 1 --speed 0.25");
  ASSERT_EQ(ended.exit_code, 0) << ended.errors;
  EXPECT_THAT(ended.output, HasSubstr("x.mp4: 21 frames"));
  EXPECT_EQ(read_file(folder_ / "x.mp4").substr(4, 4), "ftyp");
}

TEST_F(Render, ShowsTwoRecordingsSideBySide) {
  const Ended ended = render("a.mpack a.mpack -o x.mp4 --layout side-by-side --to 0.5");
  ASSERT_EQ(ended.exit_code, 0) << ended.errors;
  EXPECT_THAT(ended.output, HasSubstr("6 frames"));
}

TEST_F(Render, MakesPosters) {
  ASSERT_EQ(render("a.mpack -o x.png --poster").exit_code, 0);
  ASSERT_EQ(render("a.mpack -o x.jpg --poster --from 1").exit_code, 0);
  ASSERT_EQ(render("a.mpack -o scene.png --scene").exit_code, 0);
  EXPECT_EQ(read_file(folder_ / "x.png").substr(1, 3), "PNG");
  EXPECT_EQ(read_file(folder_ / "x.jpg").substr(0, 2), "\xff\xd8");
  EXPECT_EQ(read_file(folder_ / "scene.png").substr(1, 3), "PNG");
  EXPECT_NE(read_file(folder_ / "scene.png"), read_file(folder_ / "x.png"));
}

TEST_F(Render, ShowsTheRobotWithItsDeviations) {
  // Wheels of twice the size, once by the robot's file and once by a deviation, give the same
  // picture.
  write_atomically(folder_ / "large.yaml",
                   "mjcf: " TOUCHDOWN_SOURCE_DIR "/models/upkie.xml\nwheel_radius: 0.1\n");
  const std::string simulate = "simulate step.yaml --set end.duration=0.01 ";
  for (const char* arguments : {"-o plain.mpack", "--set robot=large.yaml -o file.mpack",
                                "--set deviations.wheel_radius_scale=2 -o drawn.mpack"}) {
    const Ended ended = touchdown_program(simulate + arguments, folder_.path());
    ASSERT_EQ(ended.exit_code, 0) << ended.errors;
  }
  for (const char* name : {"plain", "file", "drawn"}) {
    ASSERT_EQ(render(fmt::format("{0}.mpack -o {0}.png --poster --scene --from 0", name)).exit_code,
              0);
  }
  EXPECT_EQ(read_file(folder_ / "drawn.png"), read_file(folder_ / "file.png"));
  EXPECT_NE(read_file(folder_ / "drawn.png"), read_file(folder_ / "plain.png"));
}

TEST_F(Render, FilmsRunDirectoriesAndReportsThemAgain) {
  const Ended run = touchdown_program(
      "run tiny.yaml --out run --no-pictures --set video.enabled=true --set video.run=1 "
      "--set test.runs=2",
      folder_.path());
  ASSERT_EQ(run.exit_code, 0) << run.errors;
  EXPECT_FALSE(fs::exists(folder_ / "run/report.html"));
  const Ended both = render("run -o x.mp4 --layout side-by-side --to 0.5");
  ASSERT_EQ(both.exit_code, 0) << both.errors;
  const Ended one = render("run -o y.mp4 --to 0.5");
  ASSERT_EQ(one.exit_code, 0) << one.errors;
  const Ended report = touchdown_program("report run --no-video --no-replay", folder_.path());
  ASSERT_EQ(report.exit_code, 0) << report.errors;
  const std::string page = read_file(folder_ / "run/report.html");
  EXPECT_THAT(page, AllOf(HasSubstr("Bayes filter (robust)"), HasSubstr("touchdown run")));
  EXPECT_EQ(page.find("<video"), std::string::npos);
}

/// One pass paints all films of a run; the report's film alone has the same bytes.
TEST_F(Render, FilmsOfARunAreMadeOnRequest) {
  const auto ends_well = [&](const std::string& arguments) {
    const Ended ended = touchdown_program(arguments, folder_.path());
    EXPECT_EQ(ended.exit_code, 0) << arguments << ": " << ended.errors;
  };
  const auto page = [&] { return read_file(folder_ / "run/report.html"); };
  ends_well("run tiny.yaml --out run --no-video --set video.enabled=true");
  EXPECT_FALSE(fs::exists(folder_ / "run/videos/report.mp4"));
  EXPECT_EQ(page().find("<video"), std::string::npos);
  EXPECT_NE(page().find("class=\"replay\""), std::string::npos);
  EXPECT_TRUE(fs::exists(folder_ / "run/figures"));

  ends_well("report run");
  const std::string alone = read_file(folder_ / "run/videos/report.mp4");
  EXPECT_NE(page().find("<video"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder_ / "run/videos/mujoco_step.mp4"));

  ends_well("run tiny.yaml --out run --set video.enabled=true");
  EXPECT_TRUE(read_file(folder_ / "run/videos/report.mp4") == alone);
  EXPECT_TRUE(fs::exists(folder_ / "run/videos/mujoco_step.mp4"));

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
    ends_well("report run --no-replay");
    EXPECT_EQ(fs::last_write_time(film), now - std::chrono::hours(3));
    EXPECT_EQ(page().find("class=\"replay\""), std::string::npos);
    set_age(one, 2);
    ends_well("report run");
    EXPECT_GT(fs::last_write_time(film), now - std::chrono::hours(1)) << kept;
    EXPECT_TRUE(read_file(film) == alone);
  }
}

TEST_F(Render, WrongRequestsAreNamed) {
  EXPECT_THAT(complaint_about("b.mpack -o x.mp4", 2), HasSubstr("b.mpack"));
  EXPECT_THAT(complaint_about("a.mpack -o x.mp4 --spede 2", 2), HasSubstr("'--speed'"));
  EXPECT_THAT(complaint_about("a.mpack -o x.mp4 --quality best", 2), HasSubstr("draft"));
  EXPECT_THAT(complaint_about("a.mpack -o x.mp4 --from 2 --to 1", 2), HasSubstr("from 2 s to 1 s"));
  EXPECT_THAT(complaint_about("a.mpack -o x.mp4 --from 100", 2), HasSubstr("2.5"));
  EXPECT_THAT(complaint_about("a.mpack -o x.mp4 --speed 0", 2), HasSubstr("speed"));
  EXPECT_THAT(complaint_about("a.mpack -o x.mp4 --layout side-by-side", 2), HasSubstr("two runs"));
  EXPECT_THAT(complaint_about("a.mpack a.mpack -o x.mp4 --layout single", 2), HasSubstr("one run"));
  EXPECT_THAT(complaint_about(". -o x.mp4", 2), HasSubstr("no run directory"));
  EXPECT_THAT(complaint_about("a.mpack -o a.mpack/x.mp4", 1), HasSubstr("cannot be written"));
  folder_.write("cut.mpack", read_file(folder_ / "a.mpack").substr(0, 100));
  EXPECT_THAT(complaint_about("cut.mpack -o x.mp4", 2), HasSubstr("cut.mpack"));
  const Ended report = touchdown_program("report .", folder_.path());
  EXPECT_EQ(report.exit_code, 2);
  EXPECT_THAT(report.errors, HasSubstr("no run directory"));
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

TEST_F(Render, RecordingsOfAnotherRobotAreRefusedInOneLine) {
  const std::string log = read_file(folder_ / "a.mpack");
  folder_.write("joints.mpack", altered(log, "left_knee", "left_elbw"));
  const std::string joints = complaint_about("joints.mpack -o x.mp4", 2);
  EXPECT_THAT(joints, AllOf(HasSubstr("joints.mpack"), HasSubstr("left_knee")));
  folder_.write("model.mpack", altered(log, "upkie.xml", "other.xml"));
  const std::string model = complaint_about("model.mpack -o x.mp4", 2);
  EXPECT_THAT(model, HasSubstr("other.xml"));
  // A real robot's log has no terrain.
  folder_.write("real.mpack", altered(log, "touchdown", "something"));
  const std::string real = complaint_about("real.mpack -o x.mp4", 2);
  EXPECT_THAT(real, HasSubstr("terrain"));
  for (const std::string& errors : {joints, model, real}) {
    EXPECT_EQ(std::count(errors.begin(), errors.end(), '\n'), 1) << errors;
  }
}

TEST_F(Render, UnwritableOutputsAreRefusedBeforeAnythingIsDrawn) {
  for (const char* kind : {"a.mpack/x.mp4", "a.mpack/x.png --poster"}) {
    const std::string errors = complaint_about(std::string("a.mpack -o ") + kind, 1);
    EXPECT_THAT(errors, HasSubstr("cannot be written"));
    EXPECT_EQ(std::count(errors.begin(), errors.end(), '\n'), 1) << errors;
  }
  fs::create_directory(folder_ / "folder.mp4");
  EXPECT_THAT(complaint_about("a.mpack -o folder.mp4", 1), HasSubstr("cannot be written"));
  EXPECT_THAT(complaint_about("a.mpack -o .", 1),
              HasSubstr(".: cannot be written: it is a folder"));
  EXPECT_THAT(complaint_about("a.mpack -o new", 2), HasSubstr(".mp4"));
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
  const pid_t program = ::fork();
  if (program == 0) {
    const int nowhere = ::open("/dev/null", O_WRONLY);
    ::dup2(nowhere, STDOUT_FILENO);
    ::dup2(nowhere, STDERR_FILENO);
    if (::chdir(folder_.path().c_str()) == 0) {
      ::execl(TOUCHDOWN_PROGRAM, "touchdown", "render", "a.mpack", "-o", "x.mp4", "--speed",
              "0.001", "--workers", "2", nullptr);
    }
    ::_exit(127);
  }
  std::set<pid_t> workers;
  for (int i = 0; i < 3000 && workers.size() < 2; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    workers = children_of(program);
  }
  ASSERT_EQ(workers.size(), 2U);
  ::kill(program, GetParam());
  int status = 0;
  ::waitpid(program, &status, 0);
  EXPECT_FALSE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  for (const pid_t worker : workers) {
    for (int i = 0; i < 3000 && is_alive(worker); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    EXPECT_FALSE(is_alive(worker));
  }
  EXPECT_EQ(names_in(folder_.path()), before);
  // The memory that the program shares with its workers is anonymous. A named segment would be
  // here.
  for (const std::string& name : names_in("/dev/shm")) {
    EXPECT_EQ(name.find("touchdown"), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace touchdown::cli
