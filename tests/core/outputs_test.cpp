#include <array>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/program.hpp"
#include "tests/complaint.hpp"
#include "tests/core/child_process.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

namespace fs = std::filesystem;

class Outputs : public ::testing::Test {
 protected:
  std::string complaint(const std::vector<InputFile>& inputs,
                        const std::vector<fs::path>& outputs) const {
    return complaint_of<Error>([&] { check_outputs(inputs, outputs); });
  }

  const ScratchFolder folder_;
  const fs::path log_ = folder_.write("a.mpack", "log");
};

TEST_F(Outputs, ThatAreAnInputUnderAnyNameAreRefused) {
  fs::create_directories(folder_ / "sub");
  fs::create_symlink("a.mpack", folder_ / "soft");
  fs::create_symlink("soft", folder_ / "softer");
  fs::create_symlink(folder_.path(), folder_ / "folder");
  fs::create_hard_link(log_, folder_ / "hard");
  for (const char* name : {"a.mpack", "./a.mpack", "sub/../a.mpack", "sub//.././a.mpack", "soft",
                           "softer", "hard", "folder/a.mpack"}) {
    EXPECT_THAT(complaint({{folder_ / "x", "model"}, {log_, "log"}}, {folder_ / name}),
                AllOf(HasSubstr("is the log itself"), HasSubstr(name)));
    EXPECT_THAT(complaint({{folder_ / name, "log"}}, {log_}), HasSubstr("is the log itself"));
  }
  EXPECT_EQ(complaint({{log_, "log"}}, {log_}),
            fmt::format("{}: is the log itself: name another file", log_.string()));
  EXPECT_THAT(complaint({{log_, "log"}}, {folder_ / "soft"}),
              HasSubstr(fmt::format("({})", log_.string())));
}

TEST_F(Outputs, BesideTheInputsAreGood) {
  const fs::path other = folder_.write("b.mpack", "log");
  EXPECT_EQ(complaint({{log_, "log"}, {"", "model"}}, {folder_ / "new", other}), "no complaint");
  EXPECT_EQ(complaint({{log_, "log"}}, {folder_ / "no" / "such" / "folder" / "a.mpack"}),
            "no complaint");
  EXPECT_EQ(complaint({}, {}), "no complaint");
}

TEST_F(Outputs, ThatAreOneFileAreRefused) {
  const fs::path there = folder_.write("there", "");
  fs::create_symlink("there", folder_ / "link");
  fs::create_directories(folder_ / "sub");
  EXPECT_THAT(complaint({}, {there, folder_ / "x", folder_ / "link"}), HasSubstr("written twice"));
  EXPECT_THAT(complaint({}, {folder_ / "new", folder_ / "sub/../new"}), HasSubstr("written twice"));
  EXPECT_THAT(complaint({}, {folder_ / "no/new", folder_ / "no/./new"}),
              HasSubstr("written twice"));
  EXPECT_EQ(complaint({}, {folder_ / "new", folder_ / "new2", there}), "no complaint");
}

TEST_F(Outputs, AreNoDevicesAndPipesThatAFileWouldReplace) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_THAT(complaint({}, {"/dev/null"}), HasSubstr("/dev/null: is a device or a pipe"));
  EXPECT_THAT(complaint({}, {folder_ / "pipe"}), HasSubstr("device or a pipe"));
  EXPECT_EQ(complaint({{"/dev/null", "log"}}, {folder_ / "new"}), "no complaint");
}

TEST_F(Outputs, ThatCannotBeWrittenAreRefused) {
  const fs::path link = folder_ / "loop";
  fs::create_symlink("loop", link);
  const std::string cannot = ": cannot be written: ";
  EXPECT_EQ(complaint({}, {folder_.path()}), folder_.path().string() + cannot + "it is a folder");
  EXPECT_EQ(
      complaint({}, {log_ / "b.csv"}),
      fmt::format("{}{}{} is not a folder", (log_ / "b.csv").string(), cannot, log_.string()));
  for (const fs::path& output :
       {folder_ / "new/", folder_ / std::string(300, 'a'), folder_ / "loop/b.csv"}) {
    EXPECT_THAT(complaint({}, {folder_ / "good", "-", output}), HasSubstr(cannot)) << output;
  }
  EXPECT_THAT(complaint({{log_, "log"}}, {folder_.path(), log_}), HasSubstr("is the log itself"));
}

/// The standard streams of a process of its own: input from one file, output to another.
int status_with_streams(const fs::path& in, const fs::path& out,
                        const std::vector<InputFile>& inputs,
                        const std::vector<fs::path>& outputs) {
  return end_of([&] {
    ::dup2(::open(in.c_str(), O_RDONLY), STDIN_FILENO);
    ::dup2(::open(out.c_str(), O_WRONLY | O_APPEND), STDOUT_FILENO);
    return complaint_of([&] { check_outputs(inputs, outputs); }) == "no complaint" ? 0 : 2;
  });
}

TEST_F(Outputs, AreComparedWithWhatTheStandardStreamsAre) {
  const fs::path other = folder_.write("b", "");
  EXPECT_EQ(status_with_streams(log_, other, {{"-", "log"}}, {"-"}), 0);
  EXPECT_EQ(status_with_streams(log_, other, {{"-", "log"}}, {log_}), 2);
  EXPECT_EQ(status_with_streams(log_, log_, {{"-", "log"}}, {"-"}), 2);
  EXPECT_EQ(status_with_streams(other, log_, {{log_, "log"}}, {"-"}), 2);
  EXPECT_EQ(status_with_streams(other, log_, {}, {"-", log_}), 2);
  EXPECT_EQ(status_with_streams("/dev/null", "/dev/null", {{"-", "log"}}, {"-"}), 0);
}

TEST(CommandText, ReplacesBytesThatAreNoText) {
  std::string program = "x", file = "caf\xc3\xa9.yaml", broken = "b\xff\xc3.yaml";
  std::array<char*, 3> words = {program.data(), file.data(), broken.data()};
  EXPECT_EQ(command_text("touchdown train", 3, words.data()),
            "touchdown train caf\xc3\xa9.yaml b??.yaml");
}

}  // namespace
}  // namespace touchdown
