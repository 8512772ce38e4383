#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "logs/log/recording_file.hpp"
#include "program.hpp"
#include "synthetic_log.hpp"

namespace touchdown::cli {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

namespace fs = std::filesystem;

/// No request changes the files that it reads.
class Overwrite : public ::testing::Test {
 protected:
  Overwrite() {
    logs::write_recording(test::synthetic_log(2.0), folder_ / "a.mpack");
    logs::write_recording(test::synthetic_log(1.0), folder_ / "a.dat");
    write_tiny_experiment(folder_);
    fs::create_symlink("a.mpack", folder_ / "soft.mpack");
    fs::create_hard_link(folder_ / "a.mpack", folder_ / "hard.mpack");
    folder_.write("robot.xml", read_file(TOUCHDOWN_SOURCE_DIR "/models/upkie.xml"));
    folder_.write("own_robot.yaml",
                  fmt::format("robot: robot.xml\n{}", read_file(folder_ / "step.yaml")));
    const Ended fitted = touchdown_program("fit a.mpack -o m.npz --grid 20 20", folder_.path());
    EXPECT_EQ(fitted.exit_code, 0) << fitted.errors;
    fs::rename(folder_ / "m.npz", folder_ / "m.csv");
  }

  std::map<std::string, std::string> files() const {
    std::map<std::string, std::string> contents;
    for (const auto& entry : fs::recursive_directory_iterator(folder_.path())) {
      const std::string name = entry.path().filename().string();
      if (name == ".stdout" || name == ".stderr") continue;
      contents[entry.path().string()] =
          entry.is_symlink()        ? fmt::format("-> {}", fs::read_symlink(entry.path()).string())
          : entry.is_regular_file() ? read_file(entry.path())
                                    : "";
    }
    return contents;
  }

  void expect_refused(const std::string& arguments, const std::string& reason) const {
    const auto before = files();
    const Ended ended = touchdown_program(arguments, folder_.path());
    EXPECT_EQ(ended.exit_code, 2) << arguments << ": " << ended.errors;
    EXPECT_THAT(ended.errors, HasSubstr(reason)) << arguments;
    EXPECT_EQ(std::count(ended.errors.begin(), ended.errors.end(), '\n'), 1) << ended.errors;
    EXPECT_TRUE(files() == before) << arguments << " changed a file";
  }

  const ScratchFolder folder_;
};

TEST_F(Overwrite, OfALogByItsFitIsRefused) {
  for (const char* name : {"a.mpack", "./a.mpack", "soft.mpack", "hard.mpack"}) {
    expect_refused(std::string("fit a.mpack -o ") + name, "is the log itself");
    expect_refused(std::string("fit --contact hard.mpack --no-contact a.dat -o ") + name,
                   "is the log itself");
  }
}

TEST_F(Overwrite, OfALogOrModelByWhatIsEstimatedIsRefused) {
  const std::string estimate = "estimate a.mpack --model m.csv ";
  for (const char* name : {"./a.mpack", "soft.mpack", "hard.mpack"}) {
    expect_refused(estimate + "-o " + name, "is the log itself");
  }
  expect_refused(estimate + "-o m.csv", "m.csv: is the model itself");
  expect_refused("estimate - --model m.csv -o ./a.mpack <a.mpack", "is the log itself");
  // A figure also writes its data and its script.
  expect_refused("estimate a.dat --model m.csv --figure a.png", "a.dat: is the log itself");
  fs::create_hard_link(folder_ / "a.mpack", folder_ / "style.gp");
  expect_refused(estimate + "--figure new.png", "style.gp: is the log itself");
}

TEST_F(Overwrite, OfAScenarioOrRobotByItsRecordingIsRefused) {
  expect_refused("simulate step.yaml -o ./step.yaml", "is the scenario itself");
  expect_refused("simulate own_robot.yaml -o robot.xml", "is the robot itself");
  expect_refused("simulate step.yaml -o /dev/null", "/dev/null: is a device");
}

TEST_F(Overwrite, OfARecordingByItsFilmIsRefused) {
  expect_refused("render a.mpack -o soft.mpack", "is the recording itself");
  expect_refused("render a.mpack --poster -o hard.mpack", "is the recording itself");
  fs::create_directories(folder_ / "run" / "recordings");
  fs::copy(folder_ / "a.mpack", folder_ / "run" / "recordings" / "a.mpack");
  folder_.write("run/config.yaml", "name: x\n");
  expect_refused("render run -o run/recordings/a.mpack", "is the run's own file itself");
  expect_refused("render run -o run/config.yaml", "is the run's config.yaml itself");
}

TEST_F(Overwrite, IsRefusedFirstByTheOutputsExtension) {
  expect_refused("simulate step.yaml -o run.mp4",
                 "run.mp4: expected a recording with the extension .mpack");
  expect_refused("fit a.mpack -o model.txt", "model.txt: expected a model with the extension .npz");
  expect_refused("render a.mpack -o film.avi", "film.avi: expected a film with the extension .mp4");
  expect_refused("render a.mpack --poster -o film.mp4",
                 "film.mp4: expected a picture with the extension .png or .jpg");
}

TEST_F(Overwrite, ByTheOtherOutputIsRefused) {
  fs::create_symlink("both.csv", folder_ / "link.mpack");
  folder_.write("both.csv", "");
  expect_refused("estimate a.mpack --model m.csv -o both.csv -o link.mpack", "written twice");
}

}  // namespace
}  // namespace touchdown::cli
