#include "experiments/run_directory/old_runs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

namespace fs = std::filesystem;

struct OldRuns : ::testing::Test {
  void run(const std::string& name, const std::string& id) const {
    fs::create_directories(folder.path() / name / id / "tables");
    folder.write(name + "/" + id + "/config.yaml", "name: x\n");
    folder.write(name + "/" + id + "/tables/a.csv", std::string(92, 'x'));
  }
  ScratchFolder folder;
};

TEST_F(OldRuns, AreAllButTheLatestOfEachExperiment) {
  run("stairs", "aa");
  run("stairs", "bb");
  run("stairs", "cc");
  fs::create_directory_symlink("bb", folder.path() / "stairs" / "latest");
  run("tables", "dd");
  fs::create_directory_symlink("dd", folder.path() / "tables" / "latest");
  const std::vector<OldRun> old = old_runs(folder.path());
  ASSERT_EQ(old.size(), 2U);
  EXPECT_EQ(old[0].directory, folder.path() / "stairs" / "aa");
  EXPECT_EQ(old[1].directory, folder.path() / "stairs" / "cc");
  EXPECT_EQ(old[0].bytes, 100U);
}

TEST_F(OldRuns, LeaveOutFoldersThatMayBeNoRuns) {
  run("without_latest", "aa");
  run("broken_link", "bb");
  fs::create_directory_symlink("gone", folder.path() / "broken_link" / "latest");
  run("stairs", "cc");
  fs::create_directory_symlink("cc", folder.path() / "stairs" / "latest");
  fs::create_directories(folder.path() / "stairs" / "my_notes");
  run("elsewhere", "dd");
  fs::create_directory_symlink(folder.path() / "elsewhere" / "dd",
                               folder.path() / "stairs" / "linked");
  EXPECT_TRUE(old_runs(folder.path()).empty());
}

TEST_F(OldRuns, OfAMissingFolderAreAnError) {
  EXPECT_THAT([&] { old_runs(folder.path() / "rnus"); },
              ThrowsMessage<InputError>(HasSubstr("rnus: expected a folder of runs")));
}

}  // namespace
}  // namespace touchdown::experiments
