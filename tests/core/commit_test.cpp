#include <cstdlib>
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "core/fingerprint.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown {
namespace {

using ::testing::MatchesRegex;
using ::testing::StartsWith;

namespace fs = std::filesystem;

int run(const std::string& command) { return std::system((command + " >/dev/null 2>&1").c_str()); }

class Commit : public ::testing::Test {
 protected:
  /// The commit that the build records for sources in this folder.
  std::string recorded_commit(const fs::path& sources) const {
    const fs::path note = scratch_ / "share/touchdown/commit";
    EXPECT_EQ(run("cmake -DSOURCE='" + sources.string() + "' -DFILE='" + note.string() + "' -P '" +
                  TOUCHDOWN_SOURCE_DIR "/scripts/cmake/RecordCommit.cmake'"),
              0);
    return build_commit(scratch_ / "program");
  }
  void git(const std::string& arguments) const {
    ASSERT_EQ(run("git -C '" + (scratch_ / "sources").string() +
                  "' -c user.name=a -c user.email=a@b.c " + arguments),
              0)
        << arguments;
  }

  const ScratchFolder scratch_;
};

TEST_F(Commit, IsThatOfTheSourcesAndMarksChanges) {
  if (run("git --version") != 0) GTEST_SKIP() << "git is not installed";
  scratch_.write("sources/a.cpp", "1");
  git("init");
  git("add a.cpp");
  git("commit -m first");
  const std::string first = recorded_commit(scratch_ / "sources");
  EXPECT_THAT(first, MatchesRegex("[0-9a-f]{12}"));
  EXPECT_EQ(recorded_commit(scratch_ / "sources"), first);
  scratch_.write("sources/a.cpp", "2");
  EXPECT_EQ(recorded_commit(scratch_ / "sources"), first + "-dirty");
  git("commit -a -m second");
  EXPECT_THAT(recorded_commit(scratch_ / "sources"), MatchesRegex("[0-9a-f]{12}"));
  EXPECT_NE(recorded_commit(scratch_ / "sources"), first);
}

/// An archive that was unpacked inside another checkout must not get the commit of that checkout.
TEST_F(Commit, IsUnknownForSourcesWithoutTheirOwnHistory) {
  scratch_.write("sources/archive/a.cpp", "1");
  EXPECT_THAT(recorded_commit(scratch_ / "sources/archive"),
              StartsWith("unknown: built from sources"));
  if (run("git --version") != 0) return;
  git("init");
  EXPECT_THAT(recorded_commit(scratch_ / "sources/archive"),
              StartsWith("unknown: built from sources"));
}

TEST_F(Commit, IsFoundWhereTheProgramWasInstalled) {
  scratch_.write("share/touchdown/commit", "v1.2.3\n");
  scratch_.write("bin/program", "");
  EXPECT_EQ(build_commit(scratch_ / "bin/program"), "v1.2.3");
  fs::remove(scratch_ / "share/touchdown/commit");
  EXPECT_THAT(build_commit(scratch_ / "bin/program"), StartsWith("unknown"));
}

}  // namespace
}  // namespace touchdown
