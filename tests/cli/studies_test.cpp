#include <csignal>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "result_files.hpp"
#include "started_program.hpp"

namespace touchdown::cli {
namespace {

using ::testing::IsEmpty;

/// An experiment with every study with numbers from tasks: labels, odometry with its
/// trajectories, operating points, runs in closed loop.
std::string write_studies(const ScratchFolder& folder) {
  const std::string tiny = write_tiny_experiment(folder);
  folder.write("studies.yaml", read_file(folder / tiny) +
                                   "paper_tables: true\n"
                                   "odometry: {delay: [0.02]}\n"
                                   "operating_points: {leave_below: [0.25], return_above: [0.75]}\n"
                                   "closed_loop: {contact: [truth, robust, always], runs: 2,\n"
                                   "              scenes: [{scenario: step.yaml}]}\n");
  return "studies.yaml";
}

class Studies : public ::testing::Test {
 protected:
  Studies() : run_("run " + write_studies(folder_) + " --no-pictures --out ") {
    run_through(run_ + "whole");
    expected_ = result_files(folder_ / "whole");
  }

  void run_through(const std::string& arguments) const {
    const Ended ended = touchdown_program(arguments, folder_.path());
    ASSERT_EQ(ended.exit_code, 0) << ended.errors;
  }

  const ScratchFolder folder_;
  const std::string run_;
  std::map<std::string, std::size_t> expected_;
};

TEST_F(Studies, WriteTheirTablesAndTrajectories) {
  for (const char* file :
       {"tables/labels.csv", "tables/odometry.csv", "tables/operating_points.csv",
        "tables/survival.csv", "trajectories/mujoco_step_ground_truth.tum",
        "trajectories/bullet_step_truth_delayed_20ms.tum", "trajectories/bullet_step_robust.tum"}) {
    EXPECT_EQ(expected_.count(file), 1U) << file;
  }
}

TEST_F(Studies, MergeFromShardsToTheSameBytes) {
  for (const char* shard : {"2/3", "1/3", "3/3"}) {
    run_through(run_ + "parts --shard " + shard);
  }
  run_through("merge parts --no-pictures");
  EXPECT_THAT(different_files(result_files(folder_ / "parts"), expected_), IsEmpty());
}

TEST_F(Studies, EndInTheSameBytesAfterKills) {
  for (const double seconds : {0.4, 0.8, 1.2, 1.6}) {
    StartedProgram program(run_ + "killed", folder_.path());
    program.let_run(seconds);
    program.send(SIGKILL);
    static_cast<void>(program.end());
  }
  run_through(run_ + "killed");
  EXPECT_THAT(different_files(result_files(folder_ / "killed"), expected_), IsEmpty());
}

}  // namespace
}  // namespace touchdown::cli
