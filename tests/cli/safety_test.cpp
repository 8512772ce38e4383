#include <algorithm>
#include <csignal>
#include <memory>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "experiments/run_directory/lock.hpp"
#include "experiments/run_directory/own_files.hpp"
#include "result_files.hpp"
#include "started_program.hpp"

namespace touchdown::cli {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

namespace fs = std::filesystem;

/// The one-line message of a command that is refused.
std::string refusal(const ScratchFolder& folder, const std::string& arguments, int code = 2) {
  const Ended ended = touchdown_program(arguments, folder.path());
  EXPECT_EQ(ended.exit_code, code) << arguments << ": " << ended.errors;
  EXPECT_EQ(ended.output, "");
  EXPECT_EQ(std::count(ended.errors.begin(), ended.errors.end(), '\n'), 1) << ended.errors;
  return ended.errors;
}

void succeed(const ScratchFolder& folder, const std::string& arguments) {
  const Ended ended = touchdown_program(arguments, folder.path());
  ASSERT_EQ(ended.exit_code, 0) << arguments << ": " << ended.errors;
}

/// Every file below a folder, by its path there.
std::vector<std::string> files_below(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) {
      names.push_back(entry.path().lexically_relative(folder).string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// The files in a run directory that are not files of a run.
std::vector<std::string> untracked_files_in(const fs::path& directory) {
  std::vector<std::string> names = files_below(directory);
  std::erase(names, "state/key");
  std::erase(names, "state/lock");
  for (const fs::path& own : experiments::own_files(directory)) std::erase(names, own.string());
  return names;
}

TEST(RunDirectory, GoesIntoAFolderOfTheUsersAndTouchesNothingThere) {
  const ScratchFolder folder;
  const std::string run = "run " + write_tiny_experiment(folder) + " --no-pictures --out .";
  const std::vector<std::string> theirs = {".my.part.notes", ".config/.a.partition", "deep/.x.part",
                                           "deep/.success.12.0abcdef0.part.csv", "notes.md"};
  for (const std::string& file : theirs) folder.write(file, "precious");
  succeed(folder, run);
  succeed(folder, run);
  for (const std::string& file : theirs) EXPECT_EQ(read_file(folder / file), "precious") << file;
}

TEST(RunDirectory, IsNotMadeWhereTheUsersOwnFilesAre) {
  for (const std::string file : {"tables/thesis.csv", "config.yaml", "videos/deep/holiday.mp4"}) {
    const ScratchFolder folder;
    const std::string run = "run " + write_tiny_experiment(folder) + " --out mine --no-pictures";
    folder.write("mine/" + file, "precious");
    const std::string there = file.substr(0, file.find("/holiday"));
    for (const char* more : {"", " --overwrite", " --dry-run", " --shard 1/2"}) {
      EXPECT_THAT(refusal(folder, run + more),
                  AllOf(HasSubstr("mine: " + there + " is there already"), HasSubstr("--out")));
    }
    EXPECT_THAT(files_below(folder / "mine"), ElementsAre(file));
    EXPECT_EQ(read_file(folder / "mine" / file), "precious");
  }
}

TEST(RunDirectory, KeepsItsExperimentUnlessAnotherMayOverwriteIt) {
  const ScratchFolder folder;
  const std::string run = "run " + write_tiny_experiment(folder) + " --no-pictures --out ";
  succeed(folder, run + "a");
  const auto before = result_files(folder / "a");
  const std::string other = run + "a --set seed=4 --set estimators=[robust]";
  for (const char* more : {"", " --dry-run", " --shard 1/2"}) {
    EXPECT_THAT(refusal(folder, other + more),
                AllOf(HasSubstr("a: holds experiment 'tiny' (request "), HasSubstr("--overwrite")));
  }
  EXPECT_EQ(result_files(folder / "a"), before);
  const std::vector<std::string> theirs = {"a/notes.md", "a/recordings/robot.mpack",
                                           "a/tables/notes.txt"};
  for (const std::string& file : theirs) folder.write(file, "precious");
  succeed(folder, other + " --overwrite");
  for (const std::string& file : theirs) {
    EXPECT_EQ(read_file(folder / file), "precious") << file;
    fs::remove(folder / file);
  }
  succeed(folder, run + "b --set seed=4 --set estimators=[robust]");
  EXPECT_THAT(different_files(result_files(folder / "a"), result_files(folder / "b")), IsEmpty());
}

TEST(RunDirectory, OfAnotherBuildIsComputedAnewWithoutAsking) {
  const ScratchFolder folder;
  const std::string run = "run " + write_tiny_experiment(folder) + " --no-pictures --out ";
  succeed(folder, run + "whole");
  succeed(folder, run + "a");
  const std::string key = read_file(folder / "a/state/key");
  folder.write("a/state/key", key.substr(0, key.find(" build ")) + " build 0123456789abcdef\n");
  folder.write("a/report.html", "of that build");
  folder.write("a/tables/notes.txt", "precious");
  EXPECT_THAT(refusal(folder, "merge a"), HasSubstr("another build"));
  succeed(folder, run + "a");
  EXPECT_EQ(read_file(folder / "a/state/key"), key);
  EXPECT_FALSE(fs::exists(folder / "a/report.html"));
  EXPECT_EQ(read_file(folder / "a/tables/notes.txt"), "precious");
  fs::remove(folder / "a/tables/notes.txt");
  EXPECT_THAT(different_files(result_files(folder / "a"), result_files(folder / "whole")),
              IsEmpty());
}

TEST(RunDirectory, WithoutItsStateIsComputedAnew) {
  const ScratchFolder folder;
  const std::string run = "run " + write_tiny_experiment(folder) + " --no-pictures --out a";
  succeed(folder, run);
  const auto before = result_files(folder / "a");
  fs::remove_all(folder / "a/state");
  EXPECT_THAT(refusal(folder, "merge a"), HasSubstr("a: holds no part of an experiment"));
  EXPECT_THAT(refusal(folder, run + " --set seed=4"), HasSubstr("a: holds experiment 'tiny'"));
  succeed(folder, run);
  EXPECT_EQ(result_files(folder / "a"), before);
}

TEST(RunDirectory, HoldsNoUntrackedFile) {
  const ScratchFolder folder;
  const std::string run = "run " + write_tiny_experiment(folder) +
                          " --set video.enabled=true --set detail.seed=0 --set paper_tables=true"
                          " --set cross_simulator.sensitivity.runs=1";
  succeed(folder, run + " --out a");
  EXPECT_TRUE(fs::exists(folder / "a/figures/detail_bullet_spectrum_1.dat"));
  EXPECT_TRUE(fs::exists(folder / "a/videos/report.mp4"));
  EXPECT_THAT(untracked_files_in(folder / "a"), IsEmpty());
}

TEST(RunDirectory, OfAKilledStartIsContinued) {
  const ScratchFolder folder;
  const std::string run = "run " + write_tiny_experiment(folder) + " --no-pictures --out a";
  folder.write("a/state/lock", "");
  folder.write("a/state/.key.12.0abcdef0.part", "half");
  succeed(folder, run);
  EXPECT_FALSE(fs::exists(folder / "a/state/.key.12.0abcdef0.part"));
  fs::remove(folder / "a/config.yaml");
  fs::remove(folder / "a/state/scenario_000.yaml");
  succeed(folder, run + " --shard 1/2");
  EXPECT_TRUE(fs::exists(folder / "a/config.yaml"));
}

TEST(Name, OfAScenarioOrAnExperimentLeadsNowhereElse) {
  const ScratchFolder folder;
  const std::string experiment = write_tiny_experiment(folder);
  const std::vector<std::string> before = files_below(folder.path());
  for (const std::string name : {"'../../../x'", "a/b", "''", "'a b'", "\"a\\x1b[31mb\"", "."}) {
    folder.write("evil.yaml", "name: " + name + "\nterrain: {pieces: [{flat: {length: 3.0}}]}\n");
    EXPECT_THAT(
        refusal(folder, "run " + experiment + " --out b/c/d --set test.scenarios=[evil.yaml]"),
        HasSubstr("evil.yaml:1:7: name: expected a word that can name a folder"));
    EXPECT_THAT(refusal(folder, "simulate evil.yaml -o x.mpack"), HasSubstr("evil.yaml:1:7: name"));
    fs::remove(folder / "evil.yaml");
  }
  EXPECT_THAT(refusal(folder, "run " + experiment + " --set name=../x"),
              HasSubstr("name: expected a word"));
  std::vector<std::string> after = files_below(folder.path());
  std::erase(after, ".stdout");
  std::erase(after, ".stderr");
  EXPECT_EQ(after, before);
}

TEST(Lock, OfARunRefusesOtherWritersAndNamesItsOwner) {
  const ScratchFolder folder;
  const std::string run = "run " + write_long_experiment(folder) + " --out a";
  {
    StartedProgram running(run, folder.path());
    while (running.is_running() && !fs::exists(folder / "a/config.yaml")) running.let_run(0.002);
    for (const std::string& other :
         std::vector<std::string>{run, "merge a", "report a", "render a -o x.mp4",
                                  "run x.yaml --set seed=4 --overwrite --out a"}) {
      EXPECT_THAT(refusal(folder, other, 1),
                  AllOf(StartsWith("touchdown: a: is in use by process "),
                        HasSubstr(" --out a): wait until it has ended")));
    }
    EXPECT_TRUE(running.is_running());
    running.send(SIGKILL);
    running.end();
  }
  // A killed owner does not block others.
  EXPECT_THAT(refusal(folder, "merge a"), HasSubstr("parts are missing"));
}

TEST(Lock, OfAShardAdmitsOnlyOtherShards) {
  const ScratchFolder folder;
  const std::string run =
      "run " + write_tiny_experiment(folder) + " --no-pictures --set noise.seeds=30 --out a";
  StartedProgram first(run + " --shard 1/2 --set workers=1", folder.path());
  while (first.is_running() && !fs::exists(folder / "a/state/shards/1_of_2")) first.let_run(0.002);
  first.send(SIGSTOP);
  EXPECT_THAT(refusal(folder, "merge a", 1), HasSubstr("--shard 1/2"));
  EXPECT_THAT(refusal(folder, run, 1), HasSubstr("a: is in use by process "));
  succeed(folder, run + " --shard 2/2");
  first.send(SIGCONT);
  EXPECT_EQ(first.end().exit_code, 0);
  succeed(folder, "merge a --no-pictures");
}

TEST(Lock, LeavesShardsThatStartTogetherToAgreeOnTheirDirectory) {
  const ScratchFolder folder;
  const std::string run = "run " + write_tiny_experiment(folder) + " --no-pictures --out ";
  {
    // Each shard has a folder of its own for its output.
    std::vector<std::unique_ptr<ScratchFolder>> terminals;
    std::vector<std::unique_ptr<StartedProgram>> shards;
    for (const char* shard : {"1/5", "2/5", "3/5", "4/5", "5/5"}) {
      terminals.push_back(std::make_unique<ScratchFolder>());
      const fs::path& terminal = terminals.back()->path();
      fs::copy(folder.path(), terminal);
      shards.push_back(std::make_unique<StartedProgram>(
          run + (folder / "a").string() + " --shard " + shard, terminal));
    }
    for (const auto& shard : shards) {
      const Ended ended = shard->end();
      EXPECT_EQ(ended.exit_code, 0) << ended.errors;
    }
  }
  succeed(folder, "merge a --no-pictures");
  succeed(folder, run + "whole");
  EXPECT_THAT(different_files(result_files(folder / "a"), result_files(folder / "whole")),
              IsEmpty());
}

TEST(Clean, LeavesRunsThatAreInUseAndUntrackedFiles) {
  const ScratchFolder folder;
  const std::string run =
      "run " + write_tiny_experiment(folder) + " --no-pictures --set noise.seeds=";
  std::vector<fs::path> directories;
  for (const char* seeds : {"1", "2", "3"}) {
    succeed(folder, run + seeds);
    directories.push_back(fs::canonical(folder / "runs/tiny/latest"));
  }
  write_atomically(directories[0] / "notes.md", "precious");
  {
    const experiments::DirectoryLock held(directories[1], experiments::Access::shared,
                                          "touchdown x");
    const Ended cleaned = touchdown_program("clean", folder.path());
    EXPECT_EQ(cleaned.exit_code, 0) << cleaned.errors;
    EXPECT_THAT(cleaned.output,
                AllOf(HasSubstr("1 untracked files remain"), HasSubstr("is in use by process"),
                      HasSubstr("(touchdown x)")));
  }
  EXPECT_EQ(read_file(directories[0] / "notes.md"), "precious");
  EXPECT_FALSE(fs::exists(directories[0] / "tables"));
  EXPECT_TRUE(fs::exists(directories[1] / "tables/success.csv"));
  succeed(folder, "clean");
  EXPECT_FALSE(fs::exists(directories[1]));
  EXPECT_TRUE(fs::exists(directories[2] / "tables/success.csv"));
}

/// Replaces `from`, which the file must contain, by `to`.
void replace_in(const fs::path& file, const std::string& from, const std::string& to) {
  std::string content = read_file(file);
  const std::size_t at = content.find(from);
  ASSERT_NE(at, std::string::npos) << content;
  write_atomically(file, content.replace(at, from.size(), to));
}

TEST(Merge, RefusesAnExperimentThatWasChangedSinceItsPartsWereComputed) {
  const ScratchFolder folder;
  const std::string run = "run " + write_tiny_experiment(folder) + " --out ";
  succeed(folder, run + "a --shard 1/1");
  for (const auto& [file, from, to] :
       {std::tuple{"a/config.yaml", "seed: 3", "seed: 7"},
        std::tuple{"a/config.yaml", "resamples: 100", "resamples: 99"},
        std::tuple{"a/state/scenario_000.yaml", "length: 3", "length: 4"}}) {
    const std::string before = read_file(folder / file);
    replace_in(folder / file, from, to);
    EXPECT_THAT(refusal(folder, "merge a --no-pictures"),
                AllOf(HasSubstr("a: config.yaml, a scenario in state or the robot was changed"),
                      HasSubstr("expected ")));
    write_atomically(folder / file, before);
  }
  EXPECT_FALSE(fs::exists(folder / "a/tables"));
  // From another folder and with one more comment it is the same experiment.
  replace_in(folder / "a/config.yaml", "name: tiny", "name: tiny  # of mine");
  fs::create_directory(folder / "elsewhere");
  EXPECT_EQ(touchdown_program("merge ../a --no-pictures", folder / "elsewhere").exit_code, 0);
}

TEST(Merge, RefusesPartsOfOtherTasksByName) {
  const ScratchFolder folder;
  const std::string run = "run " + write_tiny_experiment(folder) + " --out ";
  succeed(folder, run + "a --shard 1/1");
  const fs::path parts = folder / "a/state/evaluation";
  const std::string one = "mujoco_step_test_000_seed_0000";
  const std::string other = "mujoco_step_test_001_seed_0001";
  fs::rename(parts / one, parts / "kept");
  fs::rename(parts / other, parts / one);
  fs::rename(parts / "kept", parts / other);
  EXPECT_THAT(
      refusal(folder, "merge a --no-pictures"),
      AllOf(HasSubstr("a/state/evaluation/" + one + ": holds '"),
            HasSubstr(" part " + other + "', expected '"), HasSubstr(" part " + one + "'")));
  EXPECT_FALSE(fs::exists(folder / "a/tables"));
  // The run itself computes the parts again.
  succeed(folder, run + "a --no-pictures");
  succeed(folder, run + "whole --no-pictures");
  EXPECT_THAT(different_files(result_files(folder / "a"), result_files(folder / "whole")),
              IsEmpty());
}

TEST(Shards, OfAnEmptyTextAreRefused) {
  const ScratchFolder folder;
  const std::string run = "run " + write_tiny_experiment(folder) + " --out a --shard ";
  EXPECT_THAT(refusal(folder, run + "''"),
              HasSubstr("--shard: expected a value, found an empty text"));
  EXPECT_EQ(touchdown_program(run + "1/2 --shard 2/2", folder.path()).exit_code, 2);
  EXPECT_FALSE(fs::exists(folder / "a"));
}

TEST(Run, ThatExceedsTheMemoryReportsHowMuchItNeedsAndWhy) {
  const ScratchFolder folder;
  const std::string run = "run " + write_tiny_experiment(folder) +
                          " --out a --set test.runs=100000 --set noise.seeds=100000";
  for (const char* more : {"", " --dry-run", " --shard 1/3"}) {
    EXPECT_THAT(refusal(folder, run + more, 1),
                AllOf(HasSubstr("test.runs=100000"), HasSubstr("noise.seeds=100000"),
                      HasSubstr(" GB of memory, and this machine has ")));
  }
  EXPECT_FALSE(fs::exists(folder / "a"));
}

}  // namespace
}  // namespace touchdown::cli
