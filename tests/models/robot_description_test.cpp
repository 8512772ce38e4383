#include "models/robot_description.hpp"

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "models/robot_model.hpp"
#include "tests/models/upkie.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::models {
namespace {

using ::testing::ElementsAre;

class RobotFile : public ::testing::Test {
 protected:
  RobotFile() { std::filesystem::copy_file(upkie_mjcf, folder_ / "upkie.xml"); }

  std::filesystem::path with(const std::string& text) const {
    write_atomically(folder_ / "robot.yaml", text);
    return folder_ / "robot.yaml";
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

TEST_F(RobotFile, CountsWithTheMjcfThatItNamesWhereContentCounts) {
  const std::filesystem::path file = with("mjcf: upkie.xml\n");
  const std::string before = robot_digest(file);
  write_atomically(folder_ / "upkie.xml", read_file(upkie_mjcf) + "\n");
  EXPECT_NE(robot_digest(file), before);
}

TEST_F(RobotFile, ListsEveryFileThatItOpens) {
  std::string text = read_file(upkie_mjcf);
  text.insert(text.rfind("</mujoco>"), "<include file=\"outer.xml\"/>");
  folder_.write("upkie.xml", text);
  folder_.write("outer.xml", "<mujoco><include file=\"parts/inner.xml\"/></mujoco>");
  folder_.write("parts/inner.xml",
                "<mujoco><compiler meshdir=\"shapes\" assetdir=\"art\"/><asset>"
                "<mesh name=\"torso\" file=\"torso.stl\"/><mesh file=\"gone.obj\"/>"
                "<texture type=\"2d\" file=\"wood.png\"/></asset></mujoco>");
  folder_.write("shapes/torso.stl", "t");
  folder_.write("art/wood.png", "w");
  folder_.write("hats/hat.stl", "h");
  folder_.write("shapes/unused.stl", "u");
  folder_.write(
      "made/robot.urdf",
      "<robot name=\"r\"><mujoco><compiler meshdir=\"../hats\"/></mujoco><link name=\"base\">"
      "<collision><geometry><mesh filename=\"hat.stl\"/></geometry></collision>"
      "<collision><geometry>"
      "<mesh filename=\"package://shapes/torso.stl\"/></geometry></collision></link>"
      "</robot>");
  const auto names = [&](const std::filesystem::path& file) {
    std::vector<std::string> all;
    for (const auto& one : robot_files(file)) {
      all.push_back(one.lexically_relative(folder_.path()).string());
    }
    return all;
  };
  const std::filesystem::path file = with("mjcf: upkie.xml\n");
  EXPECT_THAT(names(file), ElementsAre("robot.yaml", "upkie.xml", "outer.xml", "parts/inner.xml",
                                       "shapes/torso.stl", "art/wood.png"));
  EXPECT_THAT(names(folder_ / "made/robot.urdf"),
              ElementsAre("made/robot.urdf", "hats/hat.stl", "shapes/torso.stl"));
  const std::string before = robot_digest(file);
  for (const std::string name :
       {"outer.xml", "parts/inner.xml", "shapes/torso.stl", "art/wood.png"}) {
    const std::string content = read_file(folder_ / name);
    folder_.write(name, content + "\n");
    EXPECT_NE(robot_digest(file), before) << name;
    folder_.write(name, content);
  }
  folder_.write("shapes/unused.stl", "v");
  EXPECT_EQ(robot_digest(file), before);
}

TEST_F(RobotFile, MayHaveIncludesAndDefaults) {
  // Degrees, hostile defaults, and the actuators in an included file beside the robot's.
  std::string text = read_file(upkie_mjcf);
  const std::size_t begin = text.find("<actuator>");
  const std::size_t end = text.find("</actuator>") + 11;
  folder_.write("motors.xml",
                "<mujocoinclude>" + text.substr(begin, end - begin) + "</mujocoinclude>");
  text.replace(begin, end - begin, "<include file=\"motors.xml\"/>");
  text.replace(text.find("<default>"), 9,
               "<default><geom friction=\"9 9 9\" margin=\"0.1\" condim=\"1\" rgba=\"1 0 0 1\"/>");
  Terrain terrain{.pieces = {Flat{3.0}, StairFlight{}}};
  const RobotModel robot = compile_robot_model(folder_.write("robot.xml", text), terrain);
  EXPECT_EQ(robot.effort[0], 16.0);
  const int tread = mj_name2id(robot.mj.get(), mjOBJ_GEOM, "touchdown_terrain_0");
  ASSERT_GE(tread, 0);
  EXPECT_EQ(robot.mj->geom_friction[3 * tread], 1.0);
  EXPECT_EQ(robot.mj->geom_margin[tread], 0.0);
  EXPECT_EQ(robot.mj->geom_condim[tread], 3);
}

}  // namespace
}  // namespace touchdown::models
