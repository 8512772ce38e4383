#include <map>
#include <nlohmann/json.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "logs/log/recording_file.hpp"
#include "program.hpp"
#include "synthetic_log.hpp"

namespace touchdown::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

namespace fs = std::filesystem;

using StandardError = InFolder;
using StandardOutput = InFolder;
using TextThatIsNotUtf8 = InFolder;

TEST_F(StandardError, ThatIsFullOrClosedDoesNotStopARunOrChangeItsExitCode) {
  const std::string run = "run " + write_tiny_experiment(folder_) + " --no-pictures --out ";
  folder_.output_of(run + "plain");
  for (const std::string stream : {"2>/dev/full", "2>&-"}) {
    fs::remove_all(folder_ / "other");
    EXPECT_EQ(folder_.run(run + "other " + stream).exit_code, 0) << stream;
    EXPECT_EQ(folder_.text("other/tables/views.csv"), folder_.text("plain/tables/views.csv"));
  }
  for (const std::string stream : {"2>/dev/full", "2>&-", "<&- >&- 2>&-"}) {
    EXPECT_EQ(folder_.run("fit missing.mpack -o m.npz " + stream).exit_code, 2) << stream;
  }
}

TEST_F(StandardError, ThatIsClosedDoesNotEndUpInAFile) {
  logs::write_recording(test::synthetic_log(1.0), folder_ / "a.mpack");
  const std::string bytes = folder_.text("a.mpack");
  folder_.write("cut.mpack", bytes.substr(0, bytes.size() - 5));  // which causes a warning
  const std::string estimate = "estimate cut.mpack --estimator free_fall -o ";
  EXPECT_THAT(folder_.messages_of(estimate + "plain.csv"), HasSubstr("cut off"));
  folder_.output_of(estimate + "b.csv <&- 2>&-");
  EXPECT_EQ(folder_.text("b.csv"), folder_.text("plain.csv"));
}

TEST_F(StandardOutput, ThatIsFullOrClosedIsAnError) {
  for (const auto& [stream, reason] : std::map<std::string, std::string>{
           {">/dev/full", "No space left on device"}, {">&-", "Bad file descriptor"}}) {
    for (const std::string command :
         {"list", "keys", "manual --markdown", "--help", "run --help", "--version"}) {
      EXPECT_EQ(folder_.refusal_of(fmt::format("{} {}", command, stream), 1),
                "touchdown: standard output cannot be written: " + reason + "\n")
          << command << stream;
    }
    folder_.expect_refusals({{"listt " + stream, {"did you mean 'list'?"}}});
  }
  EXPECT_THAT(folder_.messages_of("list"), IsEmpty());
}

TEST_F(StandardOutput, ThatIsFullStopsALiveTableButNotTheReport) {
  const Ended run = folder_.run("run " + write_tiny_experiment(folder_) + " --out out >/dev/full");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.errors, HasSubstr("standard output cannot be written: No space left on device"));
  EXPECT_TRUE(folder_.has("out/report.html"));
  logs::write_recording(test::synthetic_log(2.0), folder_ / "a.mpack");
  const Ended live = folder_.run("estimate - --estimator free_fall <a.mpack >/dev/full");
  EXPECT_EQ(live.exit_code, 1);
  EXPECT_THAT(live.errors, HasSubstr("cannot be written"));
}

TEST_F(TextThatIsNotUtf8, IsRefusedInAFileAndReadableInTheManifest) {
  const std::string experiment = write_tiny_experiment(folder_);
  folder_.write("bad.yaml", fmt::format("# caf\xc3\xa9\n{}# \xe9\n", folder_.text(experiment)));
  folder_.expect_refusals({{"run bad.yaml --out out", {"bad.yaml:13:3: not UTF-8: byte 0xe9"}}});
  EXPECT_FALSE(folder_.has("out"));
  folder_.output_of("run " + experiment + " --no-pictures --out 'o\xff'");
  const auto manifest = nlohmann::json::parse(folder_.text("o\xff/manifest.json"));
  EXPECT_THAT(manifest["command"].get<std::string>(), HasSubstr("--out o?"));
}

}  // namespace
}  // namespace touchdown::cli
