#include <csignal>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.hpp"
#include "result_files.hpp"

namespace touchdown::cli {
namespace {

using ::testing::IsEmpty;

using Studies = InFolder;

/// An experiment with every study with numbers from tasks: labels, odometry with its
/// trajectories, operating points, runs in closed loop.
TEST_F(Studies, EndInTheSameBytesAfterKillsAndFromShards) {
  folder_.write("studies.yaml",
                folder_.text(write_tiny_experiment(folder_)) +
                    "paper_tables: true\n"
                    "odometry: {delay: [0.02]}\n"
                    "operating_points: {leave_below: [0.25], return_above: [0.75]}\n"
                    "closed_loop: {contact: [truth, robust, always], runs: 2,\n"
                    "              scenes: [{scenario: step.yaml}]}\n");
  const std::string run = "run studies.yaml --no-pictures --out ";
  folder_.output_of(run + "whole");
  const auto expected = result_files(folder_ / "whole");
  for (const char* file :
       {"tables/labels.csv", "tables/odometry.csv", "tables/operating_points.csv",
        "tables/survival.csv", "trajectories/mujoco_step_ground_truth.tum",
        "trajectories/bullet_step_truth_delayed_20ms.tum", "trajectories/bullet_step_robust.tum"}) {
    EXPECT_EQ(expected.count(file), 1U) << file;
  }
  for (const char* shard : {"2/3", "1/3", "3/3"}) {
    folder_.output_of(run + "parts --shard " + shard);
  }
  folder_.output_of("merge parts --no-pictures");
  EXPECT_THAT(different_files(result_files(folder_ / "parts"), expected), IsEmpty());
  for (const double seconds : {0.4, 0.8, 1.2, 1.6}) {
    StartedProgram program(run + "killed", folder_.path());
    program.let_run(seconds);
    program.send(SIGKILL);
    static_cast<void>(program.end());
  }
  folder_.output_of(run + "killed");
  EXPECT_THAT(different_files(result_files(folder_ / "killed"), expected), IsEmpty());
}

}  // namespace
}  // namespace touchdown::cli
