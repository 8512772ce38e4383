#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sys/wait.h>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "logs/log/recording_file.hpp"
#include "program.hpp"
#include "synthetic_log.hpp"

namespace touchdown::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

namespace fs = std::filesystem;

/// Exit code of the program with standard streams that the shell redirects.
int exit_code(const std::string& arguments_and_streams, const ScratchFolder& folder) {
  const std::string command = fmt::format("cd '{}' && '{}' {}", folder.path().string(),
                                          TOUCHDOWN_PROGRAM, arguments_and_streams);
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

TEST(StandardError, ThatIsFullOrClosedDoesNotStopARun) {
  const ScratchFolder folder;
  const std::string experiment = write_tiny_experiment(folder);
  ASSERT_EQ(exit_code("run " + experiment + " --no-pictures --out plain >plain.txt 2>&1", folder),
            0);
  const std::string scores = read_file(folder / "plain/tables/views.csv");
  const std::string other = "run " + experiment + " --no-pictures --out other >out.txt ";
  for (const std::string stream : {"2>/dev/full", "2>&-"}) {
    fs::remove_all(folder / "other");
    EXPECT_EQ(exit_code(other + stream, folder), 0) << stream;
    EXPECT_EQ(read_file(folder / "other/tables/views.csv"), scores) << stream;
  }
}

TEST(StandardError, ThatIsFullOrClosedKeepsTheExitCode) {
  const ScratchFolder folder;
  for (const std::string stream : {"2>/dev/full", "2>&-", "<&- >&- 2>&-"}) {
    EXPECT_EQ(exit_code("fit missing.mpack -o m.npz " + stream, folder), 2) << stream;
  }
}

TEST(StandardError, ThatIsClosedDoesNotEndUpInAFile) {
  const ScratchFolder folder;
  logs::write_recording(test::synthetic_log(1.0), folder / "a.mpack");
  const std::string bytes = read_file(folder / "a.mpack");
  folder.write("cut.mpack", bytes.substr(0, bytes.size() - 5));  // which causes a warning
  const std::string estimate = "estimate cut.mpack --estimator free_fall -o ";
  ASSERT_EQ(exit_code(estimate + "plain.csv >plain.txt 2>warning.txt", folder), 0);
  EXPECT_THAT(read_file(folder / "warning.txt"), HasSubstr("cut off"));
  ASSERT_EQ(exit_code(estimate + "b.csv <&- 2>&- >out.txt", folder), 0);
  EXPECT_EQ(read_file(folder / "b.csv"), read_file(folder / "plain.csv"));
}

TEST(StandardOutput, ThatIsFullOrClosedIsAnError) {
  const ScratchFolder folder;
  for (const auto& [stream, reason] : std::map<std::string, std::string>{
           {">/dev/full", "No space left on device"}, {">&-", "Bad file descriptor"}}) {
    const std::string complaint = "touchdown: standard output cannot be written: " + reason + "\n";
    for (const std::string command :
         {"list", "keys", "manual --markdown", "--help", "run --help", "--version"}) {
      EXPECT_EQ(exit_code(fmt::format("{} {} 2>errors.txt", command, stream), folder), 1)
          << command << stream;
      EXPECT_EQ(read_file(folder / "errors.txt"), complaint) << command << stream;
    }
    EXPECT_EQ(exit_code("listt " + stream + " 2>errors.txt", folder), 2) << stream;
    EXPECT_THAT(read_file(folder / "errors.txt"), HasSubstr("did you mean 'list'?"));
  }
  EXPECT_EQ(exit_code("list >out.txt 2>errors.txt", folder), 0);
  EXPECT_THAT(read_file(folder / "errors.txt"), IsEmpty());
}

TEST(StandardOutput, ThatIsFullDoesNotPreventTheReport) {
  const ScratchFolder folder;
  const std::string experiment = write_tiny_experiment(folder);
  EXPECT_EQ(exit_code("run " + experiment + " --out out >/dev/full 2>errors.txt", folder), 1);
  EXPECT_THAT(read_file(folder / "errors.txt"),
              HasSubstr("standard output cannot be written: No space left on device"));
  EXPECT_TRUE(fs::exists(folder / "out/report.html"));
}

TEST(StandardOutput, ThatIsFullStopsALiveTable) {
  const ScratchFolder folder;
  logs::write_recording(test::synthetic_log(2.0), folder / "a.mpack");
  EXPECT_EQ(exit_code("estimate - --estimator free_fall <a.mpack >/dev/full 2>errors.txt", folder),
            1);
  EXPECT_THAT(read_file(folder / "errors.txt"), HasSubstr("cannot be written"));
}

TEST(TextThatIsNotUtf8, InAFileIsShownBeforeAnythingIsComputed) {
  const ScratchFolder folder;
  write_tiny_experiment(folder);
  folder.write("bad.yaml",
               fmt::format("# caf\xc3\xa9\n{}# \xe9\n", read_file(folder / "tiny.yaml")));
  const Ended ended = touchdown_program("run bad.yaml --out out", folder.path());
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_THAT(ended.errors, HasSubstr("bad.yaml:13:3: not UTF-8: byte 0xe9"));
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST(TextThatIsNotUtf8, OnTheCommandLineEndsUpReadableInTheManifest) {
  const ScratchFolder folder;
  const std::string experiment = write_tiny_experiment(folder);
  const Ended ended =
      touchdown_program("run " + experiment + " --no-pictures --out 'o\xff'", folder.path());
  EXPECT_EQ(ended.exit_code, 0) << ended.errors;
  const auto manifest = nlohmann::json::parse(read_file(folder / "o\xff/manifest.json"));
  EXPECT_THAT(manifest["command"].get<std::string>(), HasSubstr("--out o?"));
}

}  // namespace
}  // namespace touchdown::cli
