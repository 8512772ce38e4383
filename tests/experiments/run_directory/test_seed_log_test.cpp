#include "experiments/run_directory/test_seed_log.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::experiments {
namespace {

TEST(TestSeedLog, CountsOtherEvaluationsOfTheSameSeed) {
  const ScratchFolder folder;
  const std::filesystem::path path = folder / "runs/reserved_seeds.csv";
  const auto log = [&](std::uint64_t seed, const char* id, const char* commit) {
    return log_evaluation(path, {seed, id, commit});
  };
  EXPECT_EQ(log(900'000'001, "a", "v1"), 0);
  EXPECT_EQ(log(900'000'001, "a", "v1"), 0);  // the same again, bit for bit
  EXPECT_EQ(log(900'000'001, "b", "v1"), 1);
  EXPECT_EQ(log(900'000'001, "a", "v2"), 2);
  EXPECT_EQ(log(900'000'002, "a", "v2"), 0);
  EXPECT_EQ(read_file(path),
            "seed,id,commit\n900000001,a,v1\n900000001,b,v1\n900000001,a,v2\n900000002,a,v2\n");
}

TEST(TestSeedLog, KeepsLinesThatWereAddedByHand) {
  const ScratchFolder folder;
  folder.write("reserved_seeds.csv", "seed,id,commit\nseen by hand\n900000001,x,\n");
  const std::filesystem::path path = folder / "reserved_seeds.csv";
  EXPECT_EQ(log_evaluation(path, {900'000'001, "a", "v1"}), 1);
  EXPECT_THAT(read_file(path), ::testing::HasSubstr("seen by hand"));
}

TEST(TestSeedLog, LiesInTheCheckoutWhateverTheWorkingDirectory) {
  const std::filesystem::path before = std::filesystem::current_path();
  const std::filesystem::path log = test_seed_log();
  const ScratchFolder folder;
  std::filesystem::current_path(folder / "");
  const std::filesystem::path elsewhere = test_seed_log();
  std::filesystem::current_path(before);
  EXPECT_EQ(elsewhere, log);
  EXPECT_EQ(log, std::filesystem::path(TOUCHDOWN_SOURCE_DIR) / "runs/reserved_seeds.csv");
}

}  // namespace
}  // namespace touchdown::experiments
