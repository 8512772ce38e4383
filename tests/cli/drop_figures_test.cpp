#include <filesystem>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "program.hpp"

namespace touchdown::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

namespace fs = std::filesystem;

const std::string small =
    " --set test.runs=1 --set noise.seeds=1 --set noise.torque=[1] --set noise.accelerometer=[5]"
    " --set estimators=[robust,phase]";

/// Data and scripts of the drop figures.
std::map<std::string, std::string> data_in(const fs::path& run_directory) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::directory_iterator(run_directory / "figures")) {
    const std::string name = entry.path().filename().string();
    const bool is_data = name.ends_with(".dat") || name.ends_with(".gp");
    if (is_data && (name.starts_with("detail_") || name.starts_with("phase_posterior"))) {
      files[name] = read_file(entry.path());
    }
  }
  return files;
}

TEST(DropFigures, AreTheSameForARunAndForItsShards) {
  const ScratchFolder folder;
  const std::string experiment =
      write_tiny_experiment(folder) + small + " --set detail.seed=0 --set posterior.drop=0";
  const Ended whole = touchdown_program("run " + experiment + " --out a", folder.path());
  ASSERT_EQ(whole.exit_code, 0) << whole.errors;
  EXPECT_THAT(whole.errors, Not(HasSubstr("not drawn")));
  EXPECT_TRUE(fs::exists(folder.path() / "a/figures/detail_bullet.png"));
  const auto files = data_in(folder.path() / "a");
  for (const char* name : {"detail_mujoco_1.dat", "detail_mujoco_2.dat", "detail_bullet_2.dat",
                           "detail_bullet_spectrum_0.dat", "detail_mujoco.gp",
                           "phase_posterior_1.dat", "phase_posterior_truth_2.dat"}) {
    EXPECT_EQ(files.count(name), 1U) << name;
  }
  const std::string report = read_file(folder.path() / "a/report.html");
  EXPECT_THAT(report, HasSubstr("One drop in detail: tiny, Bullet"));
  EXPECT_THAT(report, HasSubstr("The phase filter through one drop"));
  EXPECT_THAT(report, HasSubstr("href=\"figures/detail_bullet_spectrum_2.dat\""));

  for (const char* shard : {"1/2", "2/2"}) {
    const Ended part = touchdown_program(
        "run " + experiment + " --out b --set workers=1 --shard " + shard, folder.path());
    ASSERT_EQ(part.exit_code, 0) << part.errors;
  }
  EXPECT_FALSE(fs::exists(folder.path() / "b/figures"));
  const Ended merged = touchdown_program("merge b", folder.path());
  ASSERT_EQ(merged.exit_code, 0) << merged.errors;
  EXPECT_TRUE(data_in(folder.path() / "b") == files);
}

TEST(DropFigures, AMissingDropIsReportedAndTheExperimentCompletes) {
  const ScratchFolder folder;
  const std::string experiment =
      write_tiny_experiment(folder) + small + " --set detail.drop=9 --set posterior.drop=9";
  const Ended ended = touchdown_program("run " + experiment + " --out a", folder.path());
  EXPECT_EQ(ended.exit_code, 0) << ended.errors;
  for (const char* place :
       {"detail.drop: run 0 in mujoco has 1 drop of both wheels, counted from 0; none is "
        "number 9",
        "detail.drop: run 0 in bullet", "posterior.drop: run 0 in bullet"}) {
    EXPECT_THAT(ended.errors, HasSubstr(place));
  }
  EXPECT_TRUE(data_in(folder.path() / "a").empty());
  EXPECT_TRUE(fs::exists(folder.path() / "a/tables/success.csv"));
  EXPECT_TRUE(fs::exists(folder.path() / "a/report.html"));
}

}  // namespace
}  // namespace touchdown::cli
