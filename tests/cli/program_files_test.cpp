#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/program.hpp"

namespace touchdown::cli {
namespace {

namespace fs = std::filesystem;

using ::testing::HasSubstr;

/// A copy of the program, with or without files of its own.
class ProgramFiles : public InFolder {
 protected:
  ProgramFiles() { fs::create_directories(folder_ / "work"); }

  void copy_program(const std::string& to) const {
    fs::create_directories((folder_ / to).parent_path());
    fs::copy_file(TOUCHDOWN_PROGRAM, folder_ / to);
  }
  void write_files(const std::string& folder) const {
    folder_.write(folder + "/models/upkie.xml", "<mujoco/>\n");
    folder_.write(folder + "/scenarios/only_here.yaml", "name: only_here\n");
  }
  /// What a shell prints in the folder `work`.
  std::string list(const std::string& program, const std::string& environment = "") const {
    const std::string out = (folder_ / "out.txt").string();
    const std::string command =
        fmt::format("cd '{}' && {} '{}' list > '{}' 2>&1", (folder_ / "work").string(), environment,
                    (folder_ / program).string(), out);
    (void)std::system(command.c_str());
    return read_file(out);
  }
};

TEST_F(ProgramFiles, AreThoseOfTheNearestFolderAboveTheProgram) {
  copy_program("moved/build/release/touchdown");
  write_files("moved");
  EXPECT_THAT(list("moved/build/release/touchdown"), HasSubstr("only_here"));
  EXPECT_THAT(list("moved/build/release/touchdown"),
              HasSubstr((folder_ / "moved").string() + " (beside the program)"));
  // An installation in a checkout has its own.
  copy_program("moved/prefix/bin/touchdown");
  write_files("moved/prefix/share/touchdown");
  EXPECT_THAT(list("moved/prefix/bin/touchdown"),
              HasSubstr((folder_ / "moved/prefix/share/touchdown").string() + " (beside"));
}

TEST_F(ProgramFiles, OfAProgramAloneAreThoseThatTheVariableNames) {
  copy_program("alone/touchdown");
  write_files("elsewhere");
  const std::string named =
      list("alone/touchdown", "TOUCHDOWN=" + (folder_ / "elsewhere").string());
  EXPECT_THAT(named, HasSubstr("(named by TOUCHDOWN)"));
  EXPECT_THAT(named, HasSubstr("only_here"));
  EXPECT_THAT(list("alone/touchdown", "TOUCHDOWN=/nowhere"),
              HasSubstr("TOUCHDOWN=/nowhere: has no models/upkie.xml: expected a checkout"));
  EXPECT_THAT(list("alone/touchdown"), HasSubstr("from which the program was built"));
}

}  // namespace
}  // namespace touchdown::cli
