#include <csignal>
#include <filesystem>
#include <map>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/machine.hpp"
#include "experiments/run_directory/store.hpp"
#include "program.hpp"
#include "result_files.hpp"
#include "tests/draws.hpp"

namespace touchdown::cli {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

namespace fs = std::filesystem;

using Studies = InFolder;

/// An experiment with every study with numbers from tasks: odometry with its
/// trajectories, runs in closed loop.
TEST_F(Studies, EndInTheSameBytesAfterKillsAndFromShards) {
  folder_.write("studies.yaml", folder_.text(write_tiny_experiment(folder_)) +
                                    "paper_tables: true\n"
                                    "odometry: {delay: [0.02]}\n"
                                    "closed_loop: {contact: [truth, robust, always], runs: 2,\n"
                                    "              scenes: [{scenario: step.yaml}]}\n");
  const std::string run = "run studies.yaml --no-pictures --out ";
  folder_.output_of(run + "whole");
  const auto expected = result_files(folder_ / "whole");
  for (const char* file :
       {"tables/odometry.csv", "tables/survival.csv", "trajectories/mujoco_step_ground_truth.tum",
        "trajectories/bullet_step_truth_delayed_20ms.tum", "trajectories/bullet_step_robust.tum"}) {
    EXPECT_EQ(expected.count(file), 1U) << file;
  }
  for (const char* shard : {"2/3", "1/3", "3/3"}) {
    folder_.output_of(run + "parts --shard " + shard);
  }
  folder_.output_of("run parts --no-pictures");
  EXPECT_THAT(different_files(result_files(folder_ / "parts"), expected), IsEmpty());
  for (const double seconds : {0.4, 0.8, 1.2, 1.6}) {
    StartedProgram program(run + "killed", folder_.path());
    program.let_run(seconds);
    program.send(SIGKILL);
    static_cast<void>(program.end());
  }
  EXPECT_EQ(folder_.execute(run + "killed").exit_code, 0);
  EXPECT_THAT(different_files(result_files(folder_ / "killed"), expected), IsEmpty());
}

/// One engine's fit cannot gain 1 over always contact. With a `smallest_gain` of 1 the
/// verdict must fail, with -1 and a `largest_loss` of 1 it must hold.
struct CrossSimulator : InFolder {
  Ended check(const std::string& smallest_gain, const std::string& demanded) const {
    write_tiny_experiment(folder_);
    folder_.write("check.yaml",
                  "name: check\n"
                  "estimators: [robust]\n"
                  "fit: {scenarios: [step.yaml]}\n"
                  "test: {scenarios: [step.yaml], runs: 2}\n"
                  "noise: {torque: [0.25], accelerometer: [0.23]}\n"
                  "video: {enabled: false}\n"
                  "cross_simulator: {verdict: {largest_loss: 1, smallest_gain: " +
                      smallest_gain + ", demanded: [" + demanded + "]}}\n");
    return folder_.run("run check.yaml --out out --overwrite --no-pictures");
  }
};

TEST_F(CrossSimulator, ExitsWithOneWhenADemandedVerdictFailsAndKeepsItsTables) {
  const Ended ended = check("1", "robust");
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_EQ(ended.errors.substr(ended.errors.rfind("touchdown:")),
            "touchdown: demanded verdicts fail: robust\n");
  EXPECT_THAT(folder_.text("out/tables/verdicts.csv"), HasSubstr("robust"));
  EXPECT_THAT(ended.output, AllOf(HasSubstr("robust"), HasSubstr("tables")));
  EXPECT_EQ(check("1", "").exit_code, 0) << "it was not demanded";
  EXPECT_EQ(check("-1", "robust").exit_code, 0) << "it holds";
}

const std::string small =
    " --set test.runs=1 --set noise.seeds=1 --set noise.torque=[1] --set noise.accelerometer=[5]"
    " --set estimators=[load_filter,robust]";

/// Data and scripts of the drop figures.
std::map<std::string, std::string> data_in(const fs::path& run_directory) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::directory_iterator(run_directory / "figures")) {
    const std::string name = entry.path().filename().string();
    const bool is_data = name.ends_with(".dat") || name.ends_with(".gp");
    if (is_data && name.starts_with("detail_")) files[name] = read_file(entry.path());
  }
  return files;
}

struct DropFigures : InFolder {
  const std::string run = "run " + write_tiny_experiment(folder_) + small + " --out ";
};

TEST_F(DropFigures, AreTheSameForARunAndForItsShards) {
  const std::string drops = " --set detail.seed=0";
  EXPECT_THAT(folder_.messages_of(run + "a" + drops), Not(HasSubstr("not drawn")));
  EXPECT_TRUE(folder_.has("a/figures/detail_bullet.png"));
  const auto files = data_in(folder_ / "a");
  for (const char* name : {"detail_mujoco_1.dat", "detail_mujoco_2.dat", "detail_bullet_2.dat",
                           "detail_bullet_spectrum_0.dat", "detail_mujoco.gp"}) {
    EXPECT_EQ(files.count(name), 1U) << name;
  }
  for (const char* text :
       {"One drop in detail: tiny, Bullet", "href=\"figures/detail_bullet_spectrum_2.dat\""}) {
    EXPECT_THAT(folder_.text("a/report.html"), HasSubstr(text));
  }
  for (const char* shard : {"1/2", "2/2"}) {
    folder_.output_of(run + "b --set workers=1 --shard " + shard + drops);
  }
  EXPECT_FALSE(folder_.has("b/figures"));
  folder_.output_of("run b");
  EXPECT_TRUE(data_in(folder_ / "b") == files);
}

TEST_F(DropFigures, AMissingDropIsReportedAndTheExperimentCompletes) {
  const std::string messages = folder_.messages_of(run + "a --set detail.drop=9");
  for (const char* place :
       {"detail.drop: run 0 in mujoco has 1 drop of both wheels, counted from 0; none is "
        "number 9",
        "detail.drop: run 0 in bullet"}) {
    EXPECT_THAT(messages, HasSubstr(place));
  }
  EXPECT_TRUE(data_in(folder_ / "a").empty());
  EXPECT_TRUE(folder_.has("a/tables/success.csv"));
  EXPECT_TRUE(folder_.has("a/report.html"));
}

/// A folder with the tiny experiment.
struct Shards : InFolder {
  const std::string run = "run " + write_tiny_experiment(folder_) + " --out ";
};

TEST_F(Shards, OneThreeOrEightOfThemMergeToTheBytesOfOneRun) {
  const std::string pictures = draws_all() ? "" : " --no-pictures";
  folder_.output_of(run + "whole" + pictures);
  const auto expected = result_files(folder_ / "whole");
  ASSERT_EQ(expected.count("recordings/bullet_step_test_002.mpack"), 1U);
  ASSERT_EQ(expected.count("figures/error_mujoco.png"), draws_all() ? 1U : 0U);
  for (const int count : draws_all() ? std::vector{1, 3, 8} : std::vector{1, 3}) {
    const std::string out = fmt::format("of_{}", count);
    for (int index = count; index >= 1; --index) {
      const std::string shard = fmt::format("{}/{}", index, count);
      EXPECT_THAT(folder_.output_of(fmt::format("{}{} --shard {}", run, out, shard)),
                  AllOf(HasSubstr("shard " + shard), HasSubstr("touchdown run " + out)));
    }
    EXPECT_FALSE(folder_.has(out + "/tables"));
    EXPECT_THAT(folder_.run("run " + out + pictures).errors,
                HasSubstr("6 of 6 runs were evaluated before"));
    EXPECT_THAT(different_files(result_files(folder_ / out), expected), IsEmpty()) << count;
  }
}

TEST_F(Shards, AreNotComputedTwiceAndMissingPartsAreComputedAtTheEnd) {
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
  EXPECT_FALSE(folder_.has("b/tables"));
  EXPECT_THAT(folder_.run("run b --no-pictures").errors,
              HasSubstr(" of 6 runs were evaluated before"));
  folder_.output_of("run a --no-pictures");
  EXPECT_THAT(different_files(folder_ / "b", folder_ / "a"), IsEmpty());
}

TEST_F(Shards, AreFinishedAsTheyAre) {
  folder_.output_of(run + "a --shard 1/1");
  for (const std::string flag :
       {"--set seed=4", "--shard 1/2", "--out b", "--overwrite", "--dry-run"}) {
    folder_.expect_refusals({{"run a " + flag,
                              {"a: is a run directory, of which the missing parts are computed",
                               "for " + flag.substr(0, flag.find(' ')), "a/config.yaml"}}});
  }
  folder_.expect_refusals({{"run .", {".: holds no part of an experiment"}}});
}

TEST_F(Shards, OnDifferentProcessorsAreNamedAtTheEnd) {
  folder_.output_of(run + "a --shard 1/1");
  const std::string finish = "run a --no-pictures";
  EXPECT_THAT(folder_.run(finish).errors, Not(HasSubstr("processors")));
  const std::string key = folder_.text("a/state/key");
  experiments::Store(folder_ / "a", key.substr(0, key.find('\n')))
      .put("processors", "2_of_2", std::string("of another class"));
  EXPECT_THAT(folder_.run(finish).errors,
              AllOf(HasSubstr("a: its shards ran on different processors ("),
                    HasSubstr("of another class"), HasSubstr(processor_class())));
}

TEST_F(Shards, WrongOnesAreRefusedInOneLine) {
  for (const std::string shard : {"4/3", "0/3", "x"}) {
    EXPECT_EQ(folder_.refusal_of(run + "a --shard " + shard),
              "touchdown: '" + shard +
                  "' is no shard: expected k/n with k from 1 to n, for example 1/3\n");
  }
  folder_.expect_refusals({{"run a", {}}, {run + "a --shard 1/2 --shard 2/2", {}}});
  EXPECT_FALSE(folder_.has("a"));
}

using DryRun = InFolder;

TEST_F(DryRun, PrintsTheRunDirectoryAndWritesNothing) {
  const std::string run = "run " + write_tiny_experiment(folder_);
  const std::string output = folder_.output_of(run + " --dry-run");
  EXPECT_THAT(output,
              AllOf(HasSubstr("results   runs/tiny/"), HasSubstr("\nparts     12\n"),
                    HasSubstr("\nruns      2 fitted, 6 tested, at most 20 s of simulation\n")));
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
perturbation: {yaw: 0.05}
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
  EXPECT_THAT(folder_.output_of("run parts --no-pictures"), HasSubstr("Not used: bullet_absurd"));
  EXPECT_THAT(different_files(folder_ / "parts", folder_ / "some"), IsEmpty());
}

}  // namespace
}  // namespace touchdown::cli
