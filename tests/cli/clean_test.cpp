#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/run_directory/lock.hpp"
#include "program.hpp"

namespace touchdown::cli {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

namespace fs = std::filesystem;

using Clean = InFolder;

TEST_F(Clean, RemovesOldRunsButNoneInUseAndNoUntrackedFile) {
  const std::string run =
      "run " + write_tiny_experiment(folder_) + " --no-pictures --set noise.seeds=";
  std::vector<fs::path> directories;
  for (const char* seeds : {"1", "2", "3"}) {
    folder_.output_of(run + seeds);
    directories.push_back(fs::canonical(folder_ / "runs/tiny/latest"));
  }
  EXPECT_THAT(folder_.output_of("clean --dry-run"),
              AllOf(HasSubstr("runs/tiny/"), HasSubstr("MB would be free")));
  for (const fs::path& directory : directories) {
    EXPECT_TRUE(fs::exists(directory / "tables/success.csv"));
  }
  write_atomically(directories[0] / "notes.md", "precious");
  {
    const experiments::DirectoryLock held(directories[1], experiments::Access::shared,
                                          "touchdown x");
    EXPECT_THAT(folder_.output_of("clean"),
                AllOf(HasSubstr("1 untracked files remain"), HasSubstr("is in use by process"),
                      HasSubstr("(touchdown x)"), HasSubstr("MB are free")));
  }
  EXPECT_EQ(read_file(directories[0] / "notes.md"), "precious");
  EXPECT_FALSE(fs::exists(directories[0] / "tables"));
  EXPECT_TRUE(fs::exists(directories[1] / "tables/success.csv"));
  folder_.output_of("clean");
  EXPECT_FALSE(fs::exists(directories[1]));
  EXPECT_TRUE(fs::exists(directories[2] / "tables/success.csv"));
  EXPECT_EQ(folder_.output_of("clean"), "0.0 MB are free\n");
}

/// Writes what a run leaves, with 10 MB in it.
void write_run(const ScratchFolder& folder, const std::string& name, const std::string& id) {
  folder.write("runs/" + name + "/" + id + "/config.yaml", "name: x\n");
  std::string notes;
  notes.resize(9'999'992, 'x');
  folder.write("runs/" + name + "/" + id + "/notes.txt", notes);
}

TEST_F(Clean, LeavesOutFoldersThatMayBeNoRuns) {
  write_run(folder_, "stairs", "aa");
  write_run(folder_, "stairs", "cc");
  write_run(folder_, "stairs", "bb");
  fs::create_directory_symlink("bb", folder_ / "runs/stairs/latest");
  fs::create_directories(folder_ / "runs/stairs/my_notes");
  write_run(folder_, "without_latest", "aa");
  write_run(folder_, "broken_link", "bb");
  fs::create_directory_symlink("gone", folder_ / "runs/broken_link/latest");
  write_run(folder_, "elsewhere", "dd");
  fs::create_directory_symlink(folder_ / "runs/elsewhere/dd", folder_ / "runs/stairs/linked");
  EXPECT_EQ(folder_.output_of("clean --dry-run"),
            "runs/stairs/aa  10.0 MB\nruns/stairs/cc  10.0 MB\n20.0 MB would be free\n");
}

TEST_F(Clean, OfAFolderThatIsNotThereIsAWrongRequest) {
  folder_.expect_refusals({{"clean rnus", {"rnus: expected a folder of runs"}}});
}

}  // namespace
}  // namespace touchdown::cli
