#include "experiments/run_directory/own_files.hpp"

#include <functional>
#include <thread>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "experiments/run_directory/directory.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;
using ::testing::UnorderedElementsAreArray;

namespace fs = std::filesystem;

TEST(PartialFiles, OfKilledProcessesAreRemoved) {
  const ScratchFolder folder;
  folder.write("tables/.success.1234.0abc.part.csv", "half");
  folder.write("state/.part.77.0abc.part", "half");
  folder.write("figures/.success_mujoco.4321.0abc.part/success_mujoco.gp", "half");
  folder.write("tables/success.csv", "whole");
  folder.write("tables/my.parts", "whole");
  remove_partial_files(folder.path());
  EXPECT_FALSE(std::filesystem::exists(folder / "tables/.success.1234.0abc.part.csv"));
  EXPECT_FALSE(std::filesystem::exists(folder / "state/.part.77.0abc.part"));
  EXPECT_TRUE(std::filesystem::is_empty(folder / "figures"));
  EXPECT_TRUE(std::filesystem::exists(folder / "tables/success.csv"));
  EXPECT_TRUE(std::filesystem::exists(folder / "tables/my.parts"));
}

TEST(PartialFiles, WithOtherNamesOrInOtherFoldersStay) {
  const ScratchFolder folder;
  const std::vector<std::string> untracked = {
      ".my.part.notes",  ".config/.a.partition",          "deep/.success.1234.0abc.part.csv",
      "tables/.x.part",  "tables/deep/.x.12.0abc.part",   ".film.12.0abcdef0.part.mp4",
      "tables/a.part",   ".config.12.0abcdef0.part.toml", "figures/.work.part/precious",
      "videos/.part.mp4"};
  for (const std::string& file : untracked) folder.write(file, "precious");
  const ScratchFolder elsewhere;
  elsewhere.write(".a.12.0abcdef0.part", "precious");
  fs::create_directory_symlink(elsewhere.path(), folder / "models");
  folder.write(".config.12.0abcdef0.part.yaml", "half");
  folder.write(".report.12.0abcdef0.part.html", "half");
  remove_partial_files(folder.path());
  for (const std::string& file : untracked) EXPECT_TRUE(fs::exists(folder / file)) << file;
  EXPECT_TRUE(fs::exists(elsewhere / ".a.12.0abcdef0.part"));
  EXPECT_FALSE(fs::exists(folder / ".config.12.0abcdef0.part.yaml"));
  EXPECT_FALSE(fs::exists(folder / ".report.12.0abcdef0.part.html"));
}

/// A run directory with a file of every kind, and untracked files among them.
struct OwnFiles : ::testing::Test {
  OwnFiles() {
    for (const char* file :
         {"config.yaml", "state/scenario_000.yaml", "recordings/mujoco_step_test_000.mpack",
          "figures/success_mujoco.gp", "figures/success_mujoco.png", "models/mujoco_robust.npz",
          "tables/success.csv", "videos/report.jpg", "videos/mujoco_step.mp4", "manifest.json",
          "report.html"}) {
      write_atomically(record_file(folder.path(), file), "name: a\n");
    }
    const Store store(folder.path(), "key");
    store.put("recordings", "mujoco_step_test_000.mpack", 1);
    store.put("evaluation", "mujoco_step_test_000_seed_0000", 1);
    store.put("submissions", "mine", 1);
    for (const std::string& file : untracked) folder.write(file, "precious");
    folder.write("state/key", "experiment x build y\n");
    folder.write("state/lock", "");
  }

  std::vector<std::string> left() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder.path())) {
      const fs::path name = entry.path().lexically_relative(folder.path());
      if (!entry.is_directory()) names.push_back(name.string());
    }
    return names;
  }

  const std::vector<std::string> untracked = {"notes.md",
                                              "tables/thesis.csv",
                                              "recordings/mujoco_robot_test_000.mpack",
                                              "models/mujoco_mine.npz",
                                              "figures/success_mine.png",
                                              "figures/success_mujoco_mine.dat",
                                              "figures/mine.gp",
                                              "videos/mujoco_talk.mp4",
                                              "state/todo",
                                              "data/config.yaml"};
  const ScratchFolder folder;
};

TEST_F(OwnFiles, AloneAreRemoved) {
  remove_own_files(folder.path());
  std::vector<std::string> expected = untracked;
  expected.insert(expected.end(), {"state/key", "state/lock"});
  EXPECT_THAT(left(), UnorderedElementsAreArray(expected));
  EXPECT_FALSE(fs::exists(folder / "state/evaluation"));
}

TEST_F(OwnFiles, OfAnyNameAreRemovedIfTheRunRecordedThem) {
  const std::vector<fs::path> recorded = {"tables/mine.csv", "tables/a b.md", "videos/mine.mp4",
                                          "trajectories/x.tum", "mine.html"};
  for (const fs::path& file : recorded) write_atomically(record_file(folder.path(), file), "ours");
  record_file(folder.path(), "tables/never_written.csv");
  folder.write("state/evaluation/notes", "precious");
  const std::vector<fs::path> found = own_files(folder.path());
  for (const fs::path& file : recorded) EXPECT_THAT(found, ::testing::Contains(file));
  remove_own_files(folder.path());
  std::vector<std::string> expected = untracked;
  expected.insert(expected.end(), {"state/key", "state/lock", "state/evaluation/notes"});
  EXPECT_THAT(left(), UnorderedElementsAreArray(expected));
}

TEST_F(OwnFiles, AreTheWholeLinesOfTheirJournal) {
  const std::string journal = read_file(folder / "state/files");
  record_file(folder.path(), "tables/thesis.csv.old");
  const std::string line = read_file(folder / "state/files").substr(journal.size());
  const std::vector<fs::path> before = own_files(folder.path());
  // A line that names `tables/thesis.csv` once it is torn there, with the next one behind it.
  for (std::size_t size = 0; size < line.size(); ++size) {
    folder.write("state/files", journal + line.substr(0, size));
    record_file(folder.path(), "notes.md.copy");
    EXPECT_EQ(own_files(folder.path()), before) << size;
    folder.write("notes.md.copy", "ours");
    EXPECT_EQ(own_files(folder.path()).size(), before.size() + 1) << size;
    fs::remove(folder / "notes.md.copy");
  }
  folder.write("state/files",
               journal + "\ntables/thesis.csv\n" + std::string(16, '0') + " notes.md\n");
  EXPECT_EQ(own_files(folder.path()), before);
}

TEST_F(OwnFiles, AreAllInTheJournalThatThreadsWriteAtOnce) {
  std::vector<std::jthread> threads;
  for (int thread = 0; thread < 4; ++thread) {
    threads.emplace_back([&, thread] {
      for (int i = 0; i < 50; ++i) {
        const std::string name = fmt::format("tables/{}_{}.csv", thread, i);
        write_atomically(record_file(folder.path(), name), "ours");
      }
    });
  }
  threads.clear();
  remove_own_files(folder.path());
  std::vector<std::string> expected = untracked;
  expected.insert(expected.end(), {"state/key", "state/lock"});
  EXPECT_THAT(left(), UnorderedElementsAreArray(expected));
}

TEST_F(OwnFiles, EndWithTheExperimentAndTheJournalThatNamesTheOthers) {
  const std::vector<fs::path> files = own_files(folder.path());
  ASSERT_GE(files.size(), 2U);
  EXPECT_EQ(files.end()[-2], "config.yaml");
  EXPECT_EQ(files.back(), "state/files");
  for (const fs::path& file : files) EXPECT_TRUE(fs::exists(folder.path() / file)) << file;
}

TEST_F(OwnFiles, OutsideTheDirectoryAreNone) {
  const ScratchFolder elsewhere;
  elsewhere.write("success.csv", "precious");
  const fs::path name = elsewhere.path().filename() / "success.csv";
  const std::size_t before = own_files(folder.path()).size();
  record_file(folder.path(), ".." / name);
  record_file(folder.path(), "tables/../.." / name);
  record_file(folder.path(), elsewhere / "success.csv");
  EXPECT_EQ(own_files(folder.path()).size(), before);
}

TEST_F(OwnFiles, OfAnEarlierVersionAreRefused) {
  fs::remove(folder / "state/files");
  folder.write("state/files/tables:success.csv", "");
  for (const auto& use : std::vector<std::function<void()>>{
           [&] { require_no_links(folder.path()); },
           [&] { record_file(folder.path(), "tables/success.csv"); }}) {
    EXPECT_THAT(use, ThrowsMessage<InputError>(AllOf(HasSubstr("of an earlier touchdown"),
                                                     HasSubstr("remove the directory"))));
  }
  EXPECT_TRUE(fs::exists(folder / "tables/success.csv"));
}

TEST_F(OwnFiles, AreNotSearchedForThroughLinks) {
  const ScratchFolder elsewhere;
  elsewhere.write("success.csv", "precious");
  fs::remove_all(folder / "tables");
  fs::create_directory_symlink(elsewhere.path(), folder / "tables");
  EXPECT_THAT([&] { record_file(folder.path(), "tables/success.csv"); },
              ThrowsMessage<InputError>(HasSubstr("tables: is a link")));
  remove_own_files(folder.path());
  EXPECT_TRUE(fs::exists(elsewhere / "success.csv"));
}

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
