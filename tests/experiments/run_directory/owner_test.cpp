#include "experiments/run_directory/owner.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

namespace fs = std::filesystem;

TEST(RunDirectoryOwner, IsReadFromTheKey) {
  const ScratchFolder folder;
  EXPECT_FALSE(owner_of(folder.path()).has_value());
  folder.write("state/key", key_of("0123", "abcd") + "\n");
  ASSERT_TRUE(owner_of(folder.path()).has_value());
  EXPECT_EQ(owner_of(folder.path())->request, "0123");
  EXPECT_EQ(owner_of(folder.path())->key, key_of("0123", "abcd"));
  EXPECT_EQ(owner_of(folder.path())->name, "");
  folder.write("config.yaml", "name: stairs\n");
  EXPECT_EQ(owner_of(folder.path())->name, "stairs");
  folder.write("state/key", "ssh-rsa AAAA\n");
  EXPECT_FALSE(owner_of(folder.path()).has_value());
}

TEST(RunDirectoryOwner, IsReadFromTheManifestOnceTheStateWasRemoved) {
  const ScratchFolder folder;
  folder.write("config.yaml", "name: stairs\n");
  for (const char* other : {"{}", "[1", R"({"id": "0123", "versions": {"npm": "8"}})",
                            R"({"versions": {"touchdown": "0.1.0"}})"}) {
    folder.write("manifest.json", other);
    EXPECT_FALSE(owner_of(folder.path()).has_value()) << other;
  }
  folder.write("manifest.json", R"({"id": "0123", "versions": {"touchdown": "0.1.0"}})");
  ASSERT_TRUE(owner_of(folder.path()).has_value());
  EXPECT_EQ(owner_of(folder.path())->request, "0123");
  EXPECT_EQ(owner_of(folder.path())->name, "stairs");
  EXPECT_EQ(owner_of(folder.path())->key, "");
}

TEST(TrainingDirectory, IsRefusedWithAnExperimentOrAnotherConfiguration) {
  const ScratchFolder folder;
  const auto ask = [&] {
    require_place_beside(folder.path(), "name: nmn\n", "tables/training.csv");
  };
  EXPECT_NO_THROW(ask());
  folder.write("config.yaml", "name: nmn\n");
  EXPECT_NO_THROW(ask());
  folder.write("config.yaml", "precious: true\n");
  EXPECT_THAT(ask, ThrowsMessage<InputError>(HasSubstr("config.yaml is there already")));
  // A training may continue with more iterations.
  folder.write("tables/training.csv", "iteration\n");
  EXPECT_NO_THROW(ask());
  folder.write("state/key", key_of("0123", "abcd") + "\n");
  EXPECT_THAT(ask, ThrowsMessage<InputError>(HasSubstr("holds experiment")));
}

TEST(UntrackedFiles, InPlacesOfARunsFilesAreNamed) {
  for (const std::string file : {"config.yaml", "manifest.json", "report.html", "tables/a.csv",
                                 "videos/a.mp4", "state/deep/a", "state/notes", "models/.hidden"}) {
    const ScratchFolder folder;
    folder.write(file, "precious");
    const std::string named = file == "state/deep/a" ? "state/deep" : file;
    EXPECT_THAT([&] { require_no_untracked_files(folder.path()); },
                ThrowsMessage<InputError>(AllOf(HasSubstr(folder.path().string()),
                                                HasSubstr(named + " is there already"),
                                                HasSubstr("--out"))));
  }
}

TEST(UntrackedFiles, AreNoneOnceARunOwnsTheDirectory) {
  const ScratchFolder folder;
  folder.write("config.yaml", "name: stairs\n");
  folder.write("state/scenario_000.yaml", "name: stairs\n");
  EXPECT_THROW(require_no_untracked_files(folder.path()), InputError);
  // Of two runs that start together, the first writes its key while the second checks the files.
  folder.write("state/key", key_of("0123", "abcd") + "\n");
  EXPECT_NO_THROW(require_no_untracked_files(folder.path()));
}

TEST(UntrackedFiles, AreAllowedElsewhere) {
  const ScratchFolder folder;
  EXPECT_NO_THROW(require_no_untracked_files(folder.path()));
  EXPECT_NO_THROW(require_no_untracked_files(folder / "missing"));
  folder.write("notes.md", "precious");
  folder.write("logs/shard_1_1.txt", "of the cluster");
  folder.write("my/tables/a.csv", "precious");
  fs::create_directory(folder / "tables");
  // Files of a killed or concurrent start.
  folder.write("state/lock", "");
  folder.write("state/.key.12.0abcdef0.part", "half");
  EXPECT_NO_THROW(require_no_untracked_files(folder.path()));
}

}  // namespace
}  // namespace touchdown::experiments
