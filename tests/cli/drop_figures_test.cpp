#include <filesystem>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

struct DropFigures : InFolder {
  const std::string run = "run " + write_tiny_experiment(folder_) + small + " --out ";
};

TEST_F(DropFigures, AreTheSameForARunAndForItsShards) {
  const std::string drops = " --set detail.seed=0 --set posterior.drop=0";
  EXPECT_THAT(folder_.messages_of(run + "a" + drops), Not(HasSubstr("not drawn")));
  EXPECT_TRUE(folder_.has("a/figures/detail_bullet.png"));
  const auto files = data_in(folder_ / "a");
  for (const char* name : {"detail_mujoco_1.dat", "detail_mujoco_2.dat", "detail_bullet_2.dat",
                           "detail_bullet_spectrum_0.dat", "detail_mujoco.gp",
                           "phase_posterior_1.dat", "phase_posterior_truth_2.dat"}) {
    EXPECT_EQ(files.count(name), 1U) << name;
  }
  for (const char* text : {"One drop in detail: tiny, Bullet", "The phase filter through one drop",
                           "href=\"figures/detail_bullet_spectrum_2.dat\""}) {
    EXPECT_THAT(folder_.text("a/report.html"), HasSubstr(text));
  }
  for (const char* shard : {"1/2", "2/2"}) {
    folder_.output_of(run + "b --set workers=1 --shard " + shard + drops);
  }
  EXPECT_FALSE(folder_.has("b/figures"));
  folder_.output_of("merge b");
  EXPECT_TRUE(data_in(folder_ / "b") == files);
}

TEST_F(DropFigures, AMissingDropIsReportedAndTheExperimentCompletes) {
  const std::string messages =
      folder_.messages_of(run + "a --set detail.drop=9 --set posterior.drop=9");
  for (const char* place :
       {"detail.drop: run 0 in mujoco has 1 drop of both wheels, counted from 0; none is "
        "number 9",
        "detail.drop: run 0 in bullet", "posterior.drop: run 0 in bullet"}) {
    EXPECT_THAT(messages, HasSubstr(place));
  }
  EXPECT_TRUE(data_in(folder_ / "a").empty());
  EXPECT_TRUE(folder_.has("a/tables/success.csv"));
  EXPECT_TRUE(folder_.has("a/report.html"));
}

}  // namespace
}  // namespace touchdown::cli
