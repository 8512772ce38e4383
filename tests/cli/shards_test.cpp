#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.hpp"
#include "result_files.hpp"

namespace touchdown::cli {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// A folder with the tiny experiment.
struct Shards : InFolder {
  const std::string run = "run " + write_tiny_experiment(folder_) + " --out ";
};

TEST_F(Shards, OneThreeOrEightOfThemMergeToTheBytesOfOneRun) {
  folder_.output_of(run + "whole");
  const auto expected = result_files(folder_ / "whole");
  ASSERT_EQ(expected.count("recordings/bullet_step_test_002.mpack"), 1U);
  ASSERT_EQ(expected.count("figures/error_mujoco.png"), 1U);
  for (const int count : {1, 3, 8}) {
    const std::string out = fmt::format("of_{}", count);
    for (int index = count; index >= 1; --index) {
      const std::string shard = fmt::format("{}/{}", index, count);
      EXPECT_THAT(folder_.output_of(fmt::format("{}{} --shard {}", run, out, shard)),
                  AllOf(HasSubstr("shard " + shard), HasSubstr("touchdown merge " + out)));
    }
    EXPECT_FALSE(folder_.has(out + "/tables"));
    folder_.output_of("merge " + out);
    EXPECT_THAT(different_files(result_files(folder_ / out), expected), IsEmpty()) << count;
  }
}

TEST_F(Shards, AreNotComputedTwiceAndNamedByMergeIfTheyAreMissing) {
  const auto computed = [&](const std::string& shard) {
    const std::string output = folder_.output_of(run + "a --shard " + shard);
    return output.substr(output.find(": ") + 2, output.find('\n') - output.find(": ") - 2);
  };
  EXPECT_EQ(computed("2/3"), "4 parts, 4 computed now");
  EXPECT_EQ(computed("2/3"), "4 parts, 0 computed now");
  // Another division of the same work.
  EXPECT_EQ(computed("1/1"), "12 parts, 8 computed now");

  for (const char* shard : {"1/5", "3/5", "5/5"}) {
    folder_.output_of(run + "b --shard " + shard);
  }
  folder_.expect_refusals({{"merge b", {"finish shards 2/5, 4/5 first", "--out b --shard 2/5"}}});
  EXPECT_FALSE(folder_.has("b/tables"));
}

TEST_F(Shards, WrongOnesAreRefusedInOneLine) {
  for (const std::string shard : {"4/3", "0/3", "x"}) {
    EXPECT_EQ(folder_.refusal_of(run + "a --shard " + shard),
              "touchdown: '" + shard +
                  "' is no shard: expected k/n with k from 1 to n, for example 1/3\n");
  }
  folder_.expect_refusals({{"merge a", {}}, {run + "a --shard 1/2 --shard 2/2", {}}});
  EXPECT_FALSE(folder_.has("a"));
}

using DryRun = InFolder;

TEST_F(DryRun, PrintsTheRunDirectoryAndWritesNothing) {
  const std::string run = "run " + write_tiny_experiment(folder_);
  const std::string output = folder_.output_of(run + " --dry-run");
  EXPECT_THAT(output,
              AllOf(HasSubstr("results   runs/tiny/"), HasSubstr("\nparts     12\n"),
                    HasSubstr("\nruns      2 fitted, 6 tested, at most 20 s of simulation\n"),
                    ContainsRegex("\nmemory    at least [0-9]+ MB\n"),
                    ContainsRegex("\ndisk      at most [0-9]+ MB\n$")));
  EXPECT_FALSE(folder_.has("runs"));
  folder_.output_of(run + " --shard 1/12");
  EXPECT_TRUE(folder_.has(output.substr(10, output.find('\n') - 10) + "/state/key"));
}

using FailedRun = Shards;

TEST_F(FailedRun, IsNamedAndDoesNotChangeWhatTheOthersScore) {
  folder_.write("absurd.yaml", R"(name: absurd
terrain: {pieces: [{flat: {length: 3.0}}]}
start: {x: 0.7}
forces: [{time: 0.5, duration: 1.0, force: [0.0, 0.0, 1.0e+9]}]
end: {duration: 2.5}
)");
  const std::string both = " --set test.scenarios=[step.yaml,absurd.yaml]";
  folder_.output_of(run + "good --no-pictures");
  const std::string output = folder_.output_of(run + "some --no-pictures" + both);
  for (const std::string name : {"mujoco_absurd_test_003.mpack", "bullet_absurd_test_005.mpack"}) {
    EXPECT_THAT(output, HasSubstr("Not used: " + name + " (diverged after"));
    EXPECT_THAT(folder_.text("some/manifest.json"), HasSubstr(name));
  }
  EXPECT_THAT(output, Not(HasSubstr("Not used: mujoco_step")));
  EXPECT_THAT(folder_.text("some/tables/runs.csv"), HasSubstr("mujoco,absurd,test,3,diverged"));
  EXPECT_EQ(folder_.text("some/tables/success.csv"), folder_.text("good/tables/success.csv"));
  EXPECT_THAT(folder_.output_of(run + "parts --shard 1/2" + both),
              HasSubstr("Not used: mujoco_absurd"));
  folder_.output_of(run + "parts --shard 2/2" + both);
  EXPECT_THAT(folder_.output_of("merge parts --no-pictures"), HasSubstr("Not used: bullet_absurd"));
  EXPECT_THAT(different_files(folder_ / "parts", folder_ / "some"), IsEmpty());
}

}  // namespace
}  // namespace touchdown::cli
