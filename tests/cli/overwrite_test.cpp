#include <map>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "logs/log/recording_file.hpp"
#include "program.hpp"
#include "synthetic_log.hpp"

namespace touchdown::cli {
namespace {

namespace fs = std::filesystem;

/// No request changes the files that it reads.
class Overwrite : public InFolder {
 protected:
  Overwrite() {
    logs::write_recording(test::synthetic_log(2.0), folder_ / "a.mpack");
    logs::write_recording(test::synthetic_log(1.0), folder_ / "a.dat");
    write_tiny_experiment(folder_);
    fs::create_symlink("a.mpack", folder_ / "soft.mpack");
    fs::create_hard_link(folder_ / "a.mpack", folder_ / "hard.mpack");
    folder_.write("robot.xml", read_file(TOUCHDOWN_SOURCE_DIR "/models/upkie.xml"));
    folder_.write("own_robot.yaml", fmt::format("robot: robot.xml\n{}", folder_.text("step.yaml")));
    folder_.output_of("fit a.mpack -o m.npz --grid 20 20");
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

  /// Every command is refused, and changes no file.
  void expect_refusals(const std::vector<Refusal>& refusals) const {
    const auto before = files();
    for (const Refusal& refusal : refusals) {
      folder_.expect_refusals({refusal});
      EXPECT_TRUE(files() == before) << refusal.arguments << " changed a file";
    }
  }
};

TEST_F(Overwrite, OfALogByItsFitIsRefused) {
  for (const std::string name : {"a.mpack", "./a.mpack", "soft.mpack", "hard.mpack"}) {
    expect_refusals(
        {{"fit a.mpack -o " + name, {"is the log itself"}},
         {"fit --contact hard.mpack --no-contact a.dat -o " + name, {"is the log itself"}}});
  }
}

TEST_F(Overwrite, OfAnythingThatACommandReadsIsRefused) {
  // A figure also writes its data and its script.
  fs::create_hard_link(folder_ / "a.mpack", folder_ / "style.gp");
  fs::create_directories(folder_ / "run" / "recordings");
  fs::copy(folder_ / "a.mpack", folder_ / "run" / "recordings" / "a.mpack");
  folder_.write("run/config.yaml", "name: x\n");
  fs::create_symlink("both.csv", folder_ / "link.mpack");
  folder_.write("both.csv", "");
  const std::string estimate = "estimate a.mpack --model m.csv ";
  expect_refusals({{estimate + "-o ./a.mpack", {"is the log itself"}},
                   {estimate + "-o soft.mpack", {"is the log itself"}},
                   {estimate + "-o hard.mpack", {"is the log itself"}},
                   {estimate + "-o m.csv", {"m.csv: is the model itself"}},
                   {"estimate - --model m.csv -o ./a.mpack <a.mpack", {"is the log itself"}},
                   {"estimate a.dat --model m.csv --figure a.png", {"a.dat: is the log itself"}},
                   {estimate + "--figure new.png", {"style.gp: is the log itself"}},
                   {estimate + "-o both.csv -o link.mpack", {"written twice"}},
                   {"simulate step.yaml -o ./step.yaml", {"is the scenario itself"}},
                   {"simulate own_robot.yaml -o robot.xml", {"is the robot itself"}},
                   {"simulate step.yaml -o /dev/null", {"/dev/null: is a device"}},
                   {"render a.mpack -o soft.mpack", {"is the recording itself"}},
                   {"render a.mpack --poster -o hard.mpack", {"is the recording itself"}},
                   {"render run -o run/recordings/a.mpack", {"is the run's own file itself"}},
                   {"render run -o run/config.yaml", {"is the run's config.yaml itself"}}});
}

TEST_F(Overwrite, IsRefusedFirstByTheOutputsExtension) {
  expect_refusals(
      {{"simulate step.yaml -o run.mp4",
        {"run.mp4: expected a recording with the extension .mpack"}},
       {"fit a.mpack -o model.txt", {"model.txt: expected a model with the extension .npz"}},
       {"render a.mpack -o film.avi", {"film.avi: expected a film with the extension .mp4"}},
       {"render a.mpack --poster -o film.mp4",
        {"film.mp4: expected a picture with the extension .png or .jpg"}}});
}

}  // namespace
}  // namespace touchdown::cli
