#include <algorithm>
#include <csignal>
#include <memory>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/run_directory/lock.hpp"
#include "experiments/run_directory/own_files.hpp"
#include "program.hpp"
#include "result_files.hpp"

namespace touchdown::cli {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

namespace fs = std::filesystem;

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

/// A folder with the tiny experiment.
struct RunDirectory : InFolder {
  const std::string run = "run " + write_tiny_experiment(folder_) + " --no-pictures --out ";

  void write_precious(const std::vector<std::string>& files) const {
    for (const std::string& file : files) folder_.write(file, "precious");
  }
  void expect_precious(const std::vector<std::string>& files) const {
    for (const std::string& file : files) EXPECT_EQ(folder_.text(file), "precious") << file;
  }
};

TEST_F(RunDirectory, GoesIntoAFolderOfTheUsersAndTouchesNothingThere) {
  const std::vector<std::string> theirs = {".my.part.notes", ".config/.a.partition", "deep/.x.part",
                                           "deep/.success.12.0abcdef0.part.csv", "notes.md"};
  write_precious(theirs);
  folder_.output_of(run + ".");
  folder_.output_of(run + ".");
  expect_precious(theirs);
}

TEST_F(RunDirectory, IsNotMadeWhereTheUsersOwnFilesAre) {
  for (const std::string file : {"tables/thesis.csv", "config.yaml", "videos/deep/holiday.mp4"}) {
    fs::remove_all(folder_ / "mine");
    write_precious({"mine/" + file});
    const std::string there = file.substr(0, file.find("/holiday"));
    for (const char* more : {"", " --overwrite", " --dry-run", " --shard 1/2"}) {
      folder_.expect_refusals(
          {{run + "mine" + more, {"mine: " + there + " is there already", "--out"}}});
    }
    EXPECT_THAT(files_below(folder_ / "mine"), ElementsAre(file));
    expect_precious({"mine/" + file});
  }
}

TEST_F(RunDirectory, KeepsItsExperimentUnlessAnotherMayOverwriteIt) {
  write_finished_run(folder_);
  const auto before = result_files(folder_ / "a");
  const std::string changes = " --set seed=4 --set estimators=[robust]";
  for (const char* more : {"", " --dry-run", " --shard 1/2"}) {
    folder_.expect_refusals(
        {{run + "a" + changes + more, {"a: holds experiment 'tiny' (request ", "--overwrite"}}});
  }
  for (const auto& [change, named] :
       {std::pair{"noise.seeds=3", "config.yaml is of another request (noise: seeds: 3)"},
        {"seed=9", "config.yaml is of another request (seed: 9)"},
        {"test.runs=2", "config.yaml is of another request (test: runs: 2)"}}) {
    folder_.expect_refusals({{run + "a --set " + change, {named}}});
  }
  EXPECT_EQ(result_files(folder_ / "a"), before);
  const std::vector<std::string> theirs = {"a/notes.md", "a/recordings/robot.mpack",
                                           "a/tables/notes.txt"};
  write_precious(theirs);
  folder_.output_of(run + "a --overwrite" + changes);
  expect_precious(theirs);
  for (const std::string& file : theirs) fs::remove(folder_ / file);
  folder_.output_of(run + "b" + changes);
  EXPECT_THAT(different_files(folder_ / "a", folder_ / "b"), IsEmpty());
}

TEST_F(RunDirectory, OfAnotherBuildIsComputedAnewWithoutAsking) {
  write_finished_run(folder_);
  const auto before = result_files(folder_ / "a");
  const std::string key = folder_.text("a/state/key");
  folder_.write("a/state/key", key.substr(0, key.find(" build ")) + " build 0123456789abcdef\n");
  write_atomically(experiments::record_file(folder_ / "a", "report.html"), "of that build");
  write_precious({"a/tables/notes.txt"});
  folder_.expect_refusals({{"run a", {"another build"}}});
  folder_.output_of(run + "a");
  EXPECT_EQ(folder_.text("a/state/key"), key);
  EXPECT_FALSE(folder_.has("a/report.html"));
  expect_precious({"a/tables/notes.txt"});
  fs::remove(folder_ / "a/tables/notes.txt");
  EXPECT_THAT(different_files(result_files(folder_ / "a"), before), IsEmpty());
}

TEST_F(RunDirectory, WithoutItsStateIsComputedAnew) {
  write_finished_run(folder_);
  const auto before = result_files(folder_ / "a");
  fs::remove_all(folder_ / "a/state");
  folder_.expect_refusals({{"run a", {"a: holds no part of an experiment"}},
                           {run + "a --set seed=4", {"a: holds experiment 'tiny'"}}});
  folder_.output_of(run + "a");
  EXPECT_EQ(result_files(folder_ / "a"), before);
}

TEST_F(RunDirectory, HoldsNoUntrackedFile) {
  folder_.output_of(
      "run tiny.yaml --out a --set video.enabled=true --set detail.seed=0 --set paper_tables=true "
      "--set cross_simulator.overlay.run=0");
  EXPECT_TRUE(folder_.has("a/figures/detail_bullet_spectrum_1.dat"));
  EXPECT_TRUE(folder_.has("a/videos/report.mp4"));
  EXPECT_THAT(untracked_files_in(folder_ / "a"), IsEmpty());
}

TEST_F(RunDirectory, OfAKilledStartIsContinued) {
  folder_.write("a/state/lock", "");
  folder_.write("a/state/.key.12.0abcdef0.part", "half");
  folder_.output_of(run + "a");
  EXPECT_FALSE(folder_.has("a/state/.key.12.0abcdef0.part"));
  fs::remove(folder_ / "a/config.yaml");
  fs::remove(folder_ / "a/state/scenario_000.yaml");
  folder_.output_of(run + "a --shard 1/2");
  EXPECT_TRUE(folder_.has("a/config.yaml"));
}

TEST_F(RunDirectory, IsNotMadeOfARunThatExceedsTheMemory) {
  for (const char* more : {"", " --dry-run", " --shard 1/3"}) {
    folder_.expect_refusals(
        {{run + "a --set test.runs=100000 --set noise.seeds=100000" + more,
          {"test.runs=100000", "noise.seeds=100000", " GB of memory, and this process may use "}}},
        1);
  }
  EXPECT_FALSE(folder_.has("a"));
}

TEST_F(RunDirectory, IsNotLeftByTheNameOfAScenarioOrAnExperiment) {
  const std::vector<std::string> before = files_below(folder_.path());
  for (const std::string name : {"'../../../x'", "a/b", "''", "'a b'", "."}) {
    folder_.write("evil.yaml", "name: " + name + "\nterrain: {pieces: [{flat: {length: 3.0}}]}\n");
    folder_.expect_refusals({{"run tiny.yaml --out b/c/d --set test.scenarios=[evil.yaml]",
                              {"evil.yaml:1:7: name: expected a word that can name a folder"}},
                             {"simulate evil.yaml -o x.mpack", {"evil.yaml:1:7: name"}}});
  }
  folder_.expect_refusals({{"run tiny.yaml --set name=../x", {"name: expected a word"}}});
  for (const char* name : {"evil.yaml", ".stdout", ".stderr"}) fs::remove(folder_ / name);
  EXPECT_EQ(files_below(folder_.path()), before);
}

using Lock = RunDirectory;

TEST_F(Lock, OfARunRefusesOtherWritersAndNamesItsOwner) {
  const std::string long_run = "run " + write_long_experiment(folder_) + " --out a";
  {
    StartedProgram running(long_run, folder_.path());
    running.let_run_until([&] { return folder_.has("a/config.yaml"); });
    for (const std::string& other :
         std::vector<std::string>{long_run, "run a", "report a", "render a -o x.mp4",
                                  "run x.yaml --set seed=4 --overwrite --out a"}) {
      folder_.expect_refusals(
          {{other, {"touchdown: a: is in use by process ", " --out a): wait until it has ended"}}},
          1);
    }
    EXPECT_TRUE(running.is_running());
    running.send(SIGKILL);
    running.end();
  }
  // A killed owner does not block others.
  EXPECT_THAT(folder_.execute("report a").errors, Not(HasSubstr("in use")));
}

TEST_F(Lock, OfAShardAdmitsOnlyOtherShards) {
  const std::string longer = run + "a --set noise.seeds=30";
  StartedProgram first(longer + " --shard 1/2 --set workers=1", folder_.path());
  first.let_run_until([&] { return folder_.has("a/state/processors/1_of_2"); });
  first.send(SIGSTOP);
  folder_.expect_refusals({{"run a", {"--shard 1/2"}}, {longer, {"a: is in use by process "}}}, 1);
  EXPECT_EQ(folder_.execute(longer + " --shard 2/2").exit_code, 0);
  first.send(SIGCONT);
  EXPECT_EQ(first.end().exit_code, 0);
  EXPECT_EQ(folder_.execute("run a --no-pictures").exit_code, 0);
}

TEST_F(Lock, LeavesShardsThatStartTogetherToAgreeOnTheirDirectory) {
  {
    // Each shard has a folder of its own for its output.
    std::vector<std::unique_ptr<ScratchFolder>> terminals;
    std::vector<std::unique_ptr<StartedProgram>> shards;
    for (const char* shard : {"1/5", "2/5", "3/5", "4/5", "5/5"}) {
      terminals.push_back(std::make_unique<ScratchFolder>());
      const fs::path& terminal = terminals.back()->path();
      fs::copy(folder_.path(), terminal);
      shards.push_back(std::make_unique<StartedProgram>(
          run + (folder_ / "a").string() + " --shard " + shard, terminal));
    }
    for (const auto& shard : shards) {
      const Ended ended = shard->end();
      EXPECT_EQ(ended.exit_code, 0) << ended.errors;
    }
  }
  EXPECT_EQ(folder_.execute("run a --no-pictures").exit_code, 0);
  EXPECT_EQ(folder_.execute(run + "whole").exit_code, 0);
  EXPECT_THAT(different_files(folder_ / "a", folder_ / "whole"), IsEmpty());
}

/// Replaces `from`, which the file must contain, by `to`.
void replace_in(const fs::path& file, const std::string& from, const std::string& to) {
  std::string content = read_file(file);
  const std::size_t at = content.find(from);
  ASSERT_NE(at, std::string::npos) << content;
  write_atomically(file, content.replace(at, from.size(), to));
}

using Finish = RunDirectory;

TEST_F(Finish, RefusesAnExperimentThatWasChangedSinceItsPartsWereComputed) {
  folder_.output_of(run + "a --shard 1/1");
  for (const auto& [file, from, to, named] :
       {std::tuple{"a/config.yaml", "seed: 3", "seed: 7", "a: config.yaml"},
        std::tuple{"a/config.yaml", "resamples: 100", "resamples: 99", "a: config.yaml"},
        std::tuple{"a/state/scenario_000.yaml", "length: 3", "length: 4", "step.yaml"}}) {
    const std::string before = folder_.text(file);
    replace_in(folder_ / file, from, to);
    folder_.expect_refusals(
        {{"run a --no-pictures",
          {fmt::format("{} was changed since: its inputs make request ", named), "expected "}}});
    write_atomically(folder_ / file, before);
  }
  EXPECT_FALSE(folder_.has("a/tables"));
  // From another folder and with one more comment it is the same experiment.
  replace_in(folder_ / "a/config.yaml", "name: tiny", "name: tiny  # of mine");
  const ProgramFolder elsewhere;
  elsewhere.output_of("run " + (folder_ / "a").string() + " --no-pictures");
}

TEST_F(Finish, LetsTheReportNameTablesThatWereEditedSince) {
  write_finished_run(folder_);
  const std::string report = "report a --no-video --no-replay";
  EXPECT_EQ(folder_.run(report).errors, "");
  for (const std::string table : {"results.csv", "success.csv"}) {
    const std::string before = folder_.text("a/tables/" + table);
    folder_.write("a/tables/" + table, before + "\n");
    EXPECT_THAT(folder_.run(report).errors,
                HasSubstr("a/tables/" + table + ": was edited since the run wrote it"));
    EXPECT_THAT(folder_.text("a/report.html"), HasSubstr("tables/" + table));
    folder_.write("a/tables/" + table, before);
  }
  EXPECT_EQ(folder_.run(report).errors, "");
}

TEST_F(Finish, LetsWhatShowsItsResultsNameAConfigurationThatWasEditedSince) {
  write_finished_run(folder_);
  const std::vector<std::string> shows = {"report a --no-video --no-replay", "compare a a"};
  const std::string edited = "a/config.yaml: was edited since the run wrote it";
  const std::string before = folder_.text("a/config.yaml");
  for (const auto& [from, to, is_another] :
       {std::tuple{"seed: 3", "seed: 3  # mine", false}, std::tuple{"seed: 3", "seed: 4", true},
        std::tuple{"resamples: 100", "resamples: 99", true}}) {
    replace_in(folder_ / "a/config.yaml", from, to);
    for (const std::string& show : shows) {
      const Ended ended = folder_.run(show);
      EXPECT_EQ(ended.exit_code, 0) << ended.errors;
      EXPECT_EQ(ended.errors.find(edited) != std::string::npos, is_another) << show << ", " << to;
    }
    write_atomically(folder_ / "a/config.yaml", before);
  }
}

TEST_F(Finish, ComputesPartsOfOtherTasksAnew) {
  folder_.output_of(run + "a --shard 1/1");
  const fs::path parts = folder_ / "a/state/evaluation";
  const std::string one = "mujoco_step_test_000_seed_0000";
  const std::string other = "mujoco_step_test_001_seed_0001";
  fs::rename(parts / one, parts / "kept");
  fs::rename(parts / other, parts / one);
  fs::rename(parts / "kept", parts / other);
  folder_.output_of("run a --no-pictures");
  folder_.output_of(run + "whole");
  EXPECT_THAT(different_files(folder_ / "a", folder_ / "whole"), IsEmpty());
}

}  // namespace
}  // namespace touchdown::cli
