#include "experiments/run_directory/test_seed_log.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::experiments {
namespace {

TEST(TestSeedLog, CountsOtherEvaluationsOfTheSameSeed) {
  const ScratchFolder folder;
  const auto log = [&](std::uint64_t seed, const char* id, const char* commit) {
    return log_evaluation(folder / "study" / id, {seed, id, commit});
  };
  std::filesystem::create_directory(folder / "study");
  EXPECT_EQ(log(900'000'001, "a", "v1"), 0);
  EXPECT_EQ(log(900'000'001, "a", "v1"), 0);  // the same again, bit for bit
  EXPECT_EQ(log(900'000'001, "b", "v1"), 1);
  EXPECT_EQ(log(900'000'001, "a", "v2"), 2);
  EXPECT_EQ(log(900'000'002, "a", "v2"), 0);
  EXPECT_EQ(read_file(folder / "study/reserved_seeds.csv"),
            "seed,id,commit\n900000001,a,v1\n900000001,b,v1\n900000001,a,v2\n900000002,a,v2\n");
}

TEST(TestSeedLog, KeepsLinesThatWereAddedByHand) {
  const ScratchFolder folder;
  folder.write("reserved_seeds.csv", "seed,id,commit\nseen by hand\n900000001,x,\n");
  EXPECT_EQ(log_evaluation(folder / "run", {900'000'001, "a", "v1"}), 1);
  EXPECT_THAT(read_file(folder / "reserved_seeds.csv"), ::testing::HasSubstr("seen by hand"));
}

}  // namespace
}  // namespace touchdown::experiments
