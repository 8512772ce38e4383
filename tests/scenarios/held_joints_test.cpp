#include <algorithm>
#include <cmath>
#include <regex>

#include "recordings/log/recording_file.hpp"
#include "scenarios/robot_check/robot_check.hpp"
#include "tests/models/rolling_upkie.hpp"
#include "tests/scenarios/runs.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::scenarios {
namespace {

using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

class HeldJoints : public InEveryEngine {
 protected:
  /// A file of Upkie with hip rolls that are held.
  std::string robot(const std::string& mjcf, const std::string& keys = "") const {
    folder_.write("rolling.xml", mjcf);
    return folder_
        .write("rolling.yaml",
               "# Upkie with hip rolls.\nmjcf: rolling.xml\n"
               "held: [left_roll, right_roll]\n" +
                   keys)
        .string();
  }

  /// Lets the robot stand. `push`: a force to the left after 0.1 s (N).
  static recordings::Recording stand(const std::string& robot, double seconds, double push = 0.0) {
    Scenario scenario = standing(seconds);
    if (push > 0.0) {
      scenario.forces = {{.time = 0.1, .duration = 0.3, .force = Eigen::Vector3d(0.0, push, 0.0)}};
    }
    scenario.robot = robot;
    return play(scenario, GetParam());
  }

  ScratchFolder folder_;
};

TEST_P(HeldJoints, FollowTheLawOfTheirServos) {
  for (const auto& [joint, keys, reference, kp, kd, effort] :
       std::vector<std::tuple<std::string, std::string, double, double, double, double>>{
           {"", "held_servo: {kp: 150, kd: 3}\n", 0.0, 150.0, 3.0, 40.0},
           {"", "held_servo: {kp: 30, kd: 1}\n", 0.0, 30.0, 1.0, 40.0},
           {"", "held_servo: {kp: 150, kd: 0}\n", 0.0, 150.0, 0.0, 40.0},
           {"ref=\"0.2\"", "held_servo: {kp: 150, kd: 3}\n", 0.2, 150.0, 3.0, 40.0},
           {"ref=\"-3\" range=\"-3.5 -2.5\"", "held_servo: {kp: 150, kd: 3}\n", -3.0, 150.0, 3.0,
            40.0},
           {"", "held_servo: {kp: 150, kd: 3, maximum_torque: 0.5}\n", 0.0, 150.0, 3.0, 0.5}}) {
    const recordings::Recording run = stand(robot(rolling_upkie(joint), keys), 0.5, 12.0);
    ASSERT_GT(run.steps(), 100U);
    double moved = 0.0;
    for (std::size_t k = 1; k < run.steps(); ++k) {
      for (std::size_t i = 0; i < 2; ++i) {
        ASSERT_THAT(run.truth[k].held, SizeIs(2));
        const models::ServoReading& before = run.truth[k - 1].held[i];
        const double torque =
            std::clamp(kp * (reference - before.position) - kd * before.velocity, -effort, effort);
        ASSERT_NEAR(run.truth[k].held[i].torque, torque, 1e-6) << keys << k;
        moved = std::max(moved, std::abs(before.position - reference));
      }
    }
    EXPECT_GT(moved, 1e-3) << "a servo needs an error to give a torque";
  }
}

TEST_P(HeldJoints, AreLikeRigidLegsIfTheirServosAreStiff) {
  const std::string stiff = "held_servo: {kp: 20000, kd: 200, maximum_torque: 10000}\n";
  const recordings::Recording held = stand(robot(rolling_upkie(), stiff), 2.0);
  const std::string rigid = std::regex_replace(
      rolling_upkie("", ""), std::regex("<joint name=\"(left|right)_roll\"[^>]*>"), "");
  const recordings::Recording fixed = stand(folder_.write("rigid.xml", rigid).string(), 2.0);
  ASSERT_EQ(held.steps(), fixed.steps());
  for (std::size_t k = 0; k < held.steps(); ++k) {
    ASSERT_LT((held.truth[k].base_position - fixed.truth[k].base_position).norm(), 2e-3) << k;
  }
  EXPECT_TRUE(fixed.truth.back().held.empty());
}

TEST_P(HeldJoints, AreWrittenToTheRecording) {
  const recordings::Recording run = stand(robot(rolling_upkie()), 0.1);
  recordings::write_recording(run, folder_ / "run.mpack");
  const recordings::Recording read = recordings::read_recording(folder_ / "run.mpack");
  EXPECT_EQ(read.truth.back().held[1].position, run.truth.back().held[1].position);
  EXPECT_EQ(read.truth.back().held[1].torque, run.truth.back().held[1].torque);
}

TEST_P(HeldJoints, AreTheSameAfterEveryReset) {
  Scenario scenario = standing(0.2);
  scenario.robot = robot(rolling_upkie("frictionloss=\"0.1\" damping=\"0.1\" armature=\"0.002\""));
  const auto simulator = make_simulator(scenario, GetParam());
  const recordings::Recording first = play(scenario, *simulator, 0, 0);
  const recordings::Recording second = play(scenario, *simulator, 0, 0);
  ASSERT_EQ(first.steps(), second.steps());
  EXPECT_EQ(first.truth.back().held[0].position, second.truth.back().held[0].position);
  EXPECT_EQ(first.truth.back().base_position, second.truth.back().base_position);
}

INSTANTIATE_TEST_SUITE_P(Engine, HeldJoints, ::testing::ValuesIn(simulators::simulator_names()),
                         engine_name);

TEST(ARobotCheckOfHeldJoints, ReportsWhatHoldsThem) {
  const ScratchFolder folder;
  folder.write("rolling.xml", rolling_upkie());
  const auto check = [&](const std::string& keys) {
    return check_robot(folder.write("rolling.yaml",
                                    "# Upkie.\nmjcf: rolling.xml\n"
                                    "held: [left_roll, right_roll]\n" +
                                        keys));
  };
  const RobotCheck usual = check("");
  EXPECT_THAT(usual.complaints, IsEmpty());
  ASSERT_THAT(usual.held, SizeIs(2));
  EXPECT_EQ(usual.held[0].joint, "left_roll");
  EXPECT_EQ(usual.held[0].kp, 150.0);
  EXPECT_EQ(usual.held[0].kp_source, "the file's position servo");
  EXPECT_EQ(usual.held[0].torque_limit, 40.0);
  for (const CheckedStand& stand : usual.stands) EXPECT_LT(stand.given_way, 0.05) << stand.engine;
  EXPECT_EQ(check("held_servo: {kp: 99}\n").held[1].kp_source, "held_servo");
  // Without a torque the legs splay.
  EXPECT_THAT(check("held_servo: {maximum_torque: 0}\n").complaints, Each(HasSubstr("standing")));
}

}  // namespace
}  // namespace touchdown::scenarios
