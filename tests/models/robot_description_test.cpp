#include "models/robot_description.hpp"

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "models/robot_model.hpp"
#include "tests/complaint.hpp"
#include "tests/models/upkie_mjcf.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::models {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class RobotFile : public ::testing::Test {
 protected:
  RobotFile() { std::filesystem::copy_file(upkie_mjcf, folder_ / "upkie.xml"); }

  std::filesystem::path with(const std::string& text) const {
    write_atomically(folder_ / "robot.yaml", text);
    return folder_ / "robot.yaml";
  }

  std::string complaint_about(const std::string& text) const {
    return complaint_of([&] { (void)compile_robot_model(with(text), Terrain{}); });
  }

  ScratchFolder folder_;
};

TEST_F(RobotFile, GivesBothLegsTheirActuators) {
  const RobotModel robot =
      compile_robot_model(with("mjcf: upkie.xml\n"
                               "actuators:\n"
                               "  knee: {friction: 0.06, armature: 0.003, maximum_torque: 3}\n"
                               "  wheel: {torque_lag: 0.002}\n"),
                          Terrain{});
  for (const Servo knee : {Servo::left_knee, Servo::right_knee}) {
    EXPECT_EQ(robot.actuator[index(knee)].friction, 0.06);
    EXPECT_EQ(robot.effort[index(knee)], 3.0);
    EXPECT_EQ(robot.mj->dof_armature[robot.dof_address[index(knee)]], 0.003);
  }
  EXPECT_EQ(robot.actuator[index(Servo::right_wheel)].torque_lag, 0.002);
  EXPECT_EQ(robot.effort[index(Servo::right_wheel)], 1.7) << "the motor's own limit";
  EXPECT_TRUE(robot.actuator[index(Servo::left_hip)].is_ideal());
}

TEST_F(RobotFile, WithTheMjcfAloneIsTheMjcfItself) {
  const RobotModel plain = compile_robot_model(upkie_mjcf, Terrain{});
  const RobotModel described = compile_robot_model(with("mjcf: upkie.xml\n"), Terrain{});
  ASSERT_EQ(plain.mj->nbuffer, described.mj->nbuffer);
  const auto* const bytes = static_cast<const char*>(plain.mj->buffer);
  EXPECT_TRUE(
      std::equal(bytes, bytes + plain.mj->nbuffer, static_cast<const char*>(described.mj->buffer)));
}

TEST_F(RobotFile, TakesFrictionFromTheJointsOfAnMjcf) {
  std::string text = read_file(upkie_mjcf);
  const std::string knee = "<joint name=\"left_knee\"";
  text.replace(text.find(knee), knee.size(),
               knee + " frictionloss=\"0.05\" damping=\"0.02\" armature=\"0.004\"");
  write_atomically(folder_ / "own.xml", text);
  const RobotModel robot = compile_robot_model(folder_ / "own.xml", Terrain{});
  const Actuator& actuator = robot.actuator[index(Servo::left_knee)];
  EXPECT_EQ(actuator.friction, 0.05);
  EXPECT_EQ(actuator.viscous, 0.02);
  EXPECT_EQ(actuator.armature, 0.004);
  const int dof = robot.dof_address[index(Servo::left_knee)];
  EXPECT_EQ(robot.mj->dof_frictionloss[dof], 0.0) << "the simulators' own law, not MuJoCo's";
  EXPECT_EQ(robot.mj->dof_damping[dof], 0.0);
}

TEST_F(RobotFile, WithABadValueReportsItsPositionAndTheExpectation) {
  EXPECT_THAT(complaint_about("mjcf: upkie.xml\nactuators:\n  knee: {friction: -1}\n"),
              AllOf(HasSubstr("robot.yaml:3:20"), HasSubstr("friction")));
  EXPECT_THAT(complaint_about("mjcf: upkie.xml\nactuators:\n  knee: {command_delay: -0.1}\n"),
              HasSubstr("command_delay"));
  EXPECT_THAT(complaint_about("mjcf: upkie.xml\nactuators:\n  knee: {fricton: 1}\n"),
              HasSubstr("did you mean 'friction'?"));
  EXPECT_THAT(complaint_about("mjcf: upkie.xml\nactuators: {elbow: {}}\n"), HasSubstr("elbow"));
  EXPECT_THAT(complaint_about("actuators: {}\n"), HasSubstr("mjcf"));
  EXPECT_THAT(complaint_about("mjcf: nothing.xml\n"),
              AllOf(HasSubstr("robot.yaml:1:7: mjcf: "), HasSubstr("nothing.xml: no such file")));
  EXPECT_THAT(complaint_about("mass: 2\nmjcf: upky.xml\n"),
              AllOf(HasSubstr("robot.yaml:2:7: mjcf: "), HasSubstr("did you mean 'upkie.xml'?")));
  EXPECT_THAT(complaint_about("mjcf: " TOUCHDOWN_SOURCE_DIR "/models/upky.xml\n"),
              HasSubstr("did you mean 'upkie.xml'?"))
      << "elsewhere";
}

TEST_F(RobotFile, CountsWithTheMjcfThatItNamesWhereContentCounts) {
  const std::filesystem::path file = with("mjcf: upkie.xml\n");
  const std::string before = robot_text(file);
  write_atomically(folder_ / "upkie.xml", read_file(upkie_mjcf) + "\n");
  EXPECT_NE(robot_text(file), before);
  EXPECT_EQ(robot_text(upkie_mjcf), read_file(upkie_mjcf));
}

}  // namespace
}  // namespace touchdown::models
