#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.hpp"

namespace touchdown::cli {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

namespace fs = std::filesystem;

TEST(Clean, RemovesOldRunsAndKeepsTheLatest) {
  const ScratchFolder folder;
  const std::string run =
      "run " + write_tiny_experiment(folder) + " --no-pictures --set noise.seeds=";
  for (const char* seeds : {"1", "2"}) {
    ASSERT_EQ(touchdown_program(run + seeds, folder.path()).exit_code, 0);
  }
  const fs::path runs = folder.path() / "runs" / "tiny";
  const fs::path latest = fs::canonical(runs / "latest");
  const auto count = [&] {
    return std::distance(fs::directory_iterator(runs), fs::directory_iterator()) - 1;
  };
  EXPECT_EQ(count(), 2);
  EXPECT_THAT(touchdown_program("clean --dry-run", folder.path()).output,
              AllOf(HasSubstr("runs/tiny/"), HasSubstr("MB would be free")));
  EXPECT_EQ(count(), 2);
  EXPECT_THAT(touchdown_program("clean", folder.path()).output, HasSubstr("MB are free"));
  EXPECT_EQ(count(), 1);
  EXPECT_TRUE(fs::exists(latest / "tables" / "success.csv"));
  EXPECT_EQ(touchdown_program("clean", folder.path()).output, "0.0 MB are free\n");
}

/// Writes what a run leaves, with 10 MB in it.
void write_run(const ScratchFolder& folder, const std::string& name, const std::string& id) {
  folder.write("runs/" + name + "/" + id + "/config.yaml", "name: x\n");
  std::string notes;
  notes.resize(9'999'992, 'x');
  folder.write("runs/" + name + "/" + id + "/notes.txt", notes);
}

TEST(Clean, LeavesOutFoldersThatMayBeNoRuns) {
  const ScratchFolder folder;
  write_run(folder, "stairs", "aa");
  write_run(folder, "stairs", "cc");
  write_run(folder, "stairs", "bb");
  fs::create_directory_symlink("bb", folder / "runs/stairs/latest");
  fs::create_directories(folder / "runs/stairs/my_notes");
  write_run(folder, "without_latest", "aa");
  write_run(folder, "broken_link", "bb");
  fs::create_directory_symlink("gone", folder / "runs/broken_link/latest");
  write_run(folder, "elsewhere", "dd");
  fs::create_directory_symlink(folder / "runs/elsewhere/dd", folder / "runs/stairs/linked");
  EXPECT_EQ(touchdown_program("clean --dry-run", folder.path()).output,
            "runs/stairs/aa  10.0 MB\nruns/stairs/cc  10.0 MB\n20.0 MB would be free\n");
}

TEST(Clean, OfAFolderThatIsNotThereIsAWrongRequest) {
  const ScratchFolder folder;
  const Ended ended = touchdown_program("clean rnus", folder.path());
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_THAT(ended.errors, HasSubstr("rnus: expected a folder of runs"));
}

}  // namespace
}  // namespace touchdown::cli
