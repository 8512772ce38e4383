#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "program.hpp"
#include "result_files.hpp"

namespace touchdown::cli {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

namespace fs = std::filesystem;

Ended in(const ScratchFolder& folder, const std::string& arguments) {
  Ended ended = touchdown_program(arguments, folder.path());
  EXPECT_EQ(ended.exit_code, 0) << arguments << ": " << ended.errors;
  return ended;
}

TEST(Shards, OneThreeOrEightOfThemMergeToTheBytesOfOneRun) {
  const ScratchFolder folder;
  const std::string run = "run " + write_tiny_experiment(folder) + " --out ";
  in(folder, run + "whole");
  const auto expected = result_files(folder / "whole");
  ASSERT_EQ(expected.count("recordings/bullet_step_test_002.mpack"), 1U);
  ASSERT_EQ(expected.count("figures/error_mujoco.png"), 1U);
  for (const int count : {1, 3, 8}) {
    const std::string out = "of_" + std::to_string(count);
    for (int index = count; index >= 1; --index) {
      const std::string shard = std::to_string(index) + "/" + std::to_string(count);
      std::string flags = out;
      flags.append(" --shard ").append(shard);
      EXPECT_THAT(in(folder, run + flags).output,
                  AllOf(HasSubstr("shard " + shard), HasSubstr("touchdown merge " + out)));
    }
    EXPECT_FALSE(fs::exists(folder / out / "tables"));
    in(folder, "merge " + out);
    EXPECT_THAT(different_files(result_files(folder / out), expected), IsEmpty()) << count;
  }
}

TEST(Shards, OnesThatAreMissingAreNamedByMerge) {
  const ScratchFolder folder;
  const std::string run = "run " + write_tiny_experiment(folder) + " --out a --shard ";
  in(folder, run + "1/5");
  in(folder, run + "3/5");
  in(folder, run + "5/5");
  const Ended ended = touchdown_program("merge a", folder.path());
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_EQ(std::count(ended.errors.begin(), ended.errors.end(), '\n'), 1) << ended.errors;
  EXPECT_THAT(ended.errors,
              AllOf(HasSubstr("finish shards 2/5, 4/5 first"), HasSubstr("--out a --shard 2/5")));
  EXPECT_FALSE(fs::exists(folder / "a/tables"));
}

TEST(Shards, AreNotComputedTwice) {
  const ScratchFolder folder;
  const std::string run = "run " + write_tiny_experiment(folder) + " --out a --shard ";
  EXPECT_THAT(in(folder, run + "2/3").output, HasSubstr("4 parts, 4 computed now"));
  EXPECT_THAT(in(folder, run + "2/3").output, HasSubstr("4 parts, 0 computed now"));
  // Another division of the same work.
  EXPECT_THAT(in(folder, run + "1/1").output, HasSubstr("12 parts, 8 computed now"));
}

TEST(Shards, WrongOnesAreRefusedInOneLine) {
  const ScratchFolder folder;
  const std::string run = "run " + write_tiny_experiment(folder) + " --out a --shard ";
  for (const std::string shard : {"4/3", "0/3", "x"}) {
    const Ended ended = touchdown_program(run + shard, folder.path());
    EXPECT_EQ(ended.exit_code, 2);
    EXPECT_EQ(ended.errors,
              "touchdown: '" + shard +
                  "' is no shard: expected k/n with k from 1 to n, for example 1/3\n");
  }
  EXPECT_EQ(touchdown_program("merge a", folder.path()).exit_code, 2);
  EXPECT_FALSE(fs::exists(folder / "a"));
}

TEST(DryRun, PrintsTheRunDirectoryAndWritesNothing) {
  const ScratchFolder folder;
  const std::string run = "run " + write_tiny_experiment(folder);
  const std::string output = in(folder, run + " --dry-run").output;
  EXPECT_THAT(output, AllOf(HasSubstr("results   runs/tiny/"), HasSubstr("\nparts     12\n")));
  EXPECT_THAT(output,
              AllOf(HasSubstr("\nruns      2 fitted, 6 tested, at most 20 s of simulation\n"),
                    ContainsRegex("\nmemory    at least [0-9]+ MB\n"),
                    ContainsRegex("\ndisk      at most [0-9]+ MB\n$")));
  EXPECT_FALSE(fs::exists(folder / "runs"));
  in(folder, run + " --shard 1/12");
  const std::string directory = output.substr(10, output.find('\n') - 10);
  EXPECT_TRUE(fs::exists(folder / directory / "state/key")) << directory;
}

TEST(FailedRun, IsNamedAndDoesNotChangeWhatTheOthersScore) {
  const ScratchFolder folder;
  const std::string run = "run " + write_tiny_experiment(folder) + " --no-pictures --out ";
  folder.write("absurd.yaml", R"(name: absurd
terrain: {pieces: [{flat: {length: 3.0}}]}
start: {x: 0.7}
forces: [{time: 0.5, duration: 1.0, force: [0.0, 0.0, 1.0e+9]}]
end: {duration: 2.5}
)");
  const std::string both = " --set test.scenarios=[step.yaml,absurd.yaml] --set test.runs=";
  in(folder, run + "good");
  const Ended ended = in(folder, run + "some" + both + "3");
  for (const char* name : {"mujoco_absurd_test_003.mpack", "bullet_absurd_test_005.mpack"}) {
    EXPECT_THAT(ended.output, HasSubstr("Not used: " + std::string(name) + " (diverged after"));
    EXPECT_THAT(read_file(folder / "some/manifest.json"), HasSubstr(name));
  }
  EXPECT_THAT(ended.output, Not(HasSubstr("Not used: mujoco_step")));
  EXPECT_THAT(read_file(folder / "some/tables/runs.csv"),
              HasSubstr("mujoco,absurd,test,3,diverged"));
  EXPECT_EQ(read_file(folder / "some/tables/success.csv"),
            read_file(folder / "good/tables/success.csv"));
  const std::string shard = run.substr(0, run.find(" --no-pictures")) + " --out parts" + both + "3";
  EXPECT_THAT(in(folder, shard + " --shard 1/2").output, HasSubstr("Not used: mujoco_absurd"));
  in(folder, shard + " --shard 2/2");
  EXPECT_THAT(in(folder, "merge parts --no-pictures").output, HasSubstr("Not used: bullet_absurd"));
  EXPECT_THAT(different_files(result_files(folder / "parts"), result_files(folder / "some")),
              IsEmpty());
}

}  // namespace
}  // namespace touchdown::cli
