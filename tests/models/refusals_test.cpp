#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "models/robot_model.hpp"
#include "tests/models/edited_upkie.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::models {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::Not;

class RefusedRobot : public ::testing::Test {
 protected:
  std::string complaint(const std::string& mjcf, const std::string& yaml = {}) {
    std::filesystem::path file = folder_.write("robot.xml", mjcf);
    if (!yaml.empty()) file = folder_.write("robot.yaml", "# a robot\nmjcf: robot.xml\n" + yaml);
    try {
      (void)compile_robot_model(file, Terrain{});
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
      return error.what();
    }
    return "no complaint";
  }

  ScratchFolder folder_;
};

/// An addition that is refused, and words of the complaint.
using Refusal = std::pair<std::string, std::string>;

TEST_F(RefusedRobot, OptionsThatChangeThePhysicsAreNamed) {
  for (const auto& [option, words] : std::vector<Refusal>{
           {"<option gravity=\"0 0 0\"/>", "gravity"},
           {"<option gravity=\"0 0 -1.62\"/>", "gravity \"0 0 -1.62\""},
           {"<option gravity=\"0 0 9.81\"/>", "gravity"},
           {"<option gravity=\"1 0 -9.81\"/>", "gravity"},
           {"<option gravity=\"down\"/>", "gravity"},
           {"<option density=\"1000\"/>", "density"},
           {"<option viscosity=\"0.001\"/>", "viscosity"},
           {"<option wind=\"3 0 0\"/>", "wind"},
           {"<option><flag contact=\"disable\"/></option>", "flag: contact"},
           {"<option><flag gravity=\"disable\"/></option>", "flag: gravity"},
           {"<option><flag limit=\"disable\"/></option>", "flag: limit"},
           {"<option><flag constraint=\"disable\"/></option>", "flag: constraint"},
           {"<option><flag passive=\"disable\"/></option>", "flag: passive"},
           {"<option><flag frictionloss=\"disable\"/></option>", "flag: frictionloss"},
           {"<option><flag actuation=\"disable\"/></option>", "flag: actuation"},
           {"<option><flag clampctrl=\"disable\"/></option>", "flag: clampctrl"}}) {
    EXPECT_THAT(complaint(edited_upkie({added(option)})),
                AllOf(MatchesRegex(".*robot.xml:[0-9]+:1: .*"), HasSubstr(words)))
        << option;
  }
}

TEST_F(RefusedRobot, WhatOneEngineAloneWouldSimulateIsNamed) {
  for (const auto& [element, words] : std::vector<Refusal>{
           {"<equality><joint joint1=\"left_knee\" polycoef=\"1 0 0 0 0\"/></equality>",
            "coupled joints"},
           {"<equality><connect body1=\"left_wheel\" body2=\"torso\" anchor=\"0 0 0\"/></equality>",
            "closed chains"},
           {"<equality><weld body1=\"left_wheel\" body2=\"torso\"/></equality>", "closed chains"},
           {"<tendon><fixed name=\"rope\"><joint joint=\"left_hip\" coef=\"1\"/></fixed></tendon>",
            "tendon fixed 'rope'"},
           {"<worldbody><geom name=\"table\" type=\"box\" size=\"1 1 1\"/></worldbody>",
            "geom 'table' of the world"},
           {"<worldbody><geom type=\"sphere\" size=\"1\"/></worldbody>", "of the world"},
           {"<worldbody><body name=\"box\"><geom size=\"1\"/></body></worldbody>", "body 'box'"},
           {"<worldbody><body name=\"ball\"><joint/><geom size=\"1\"/></body></worldbody>",
            "body 'ball'"},
           {"<worldbody><body name=\"hand\" mocap=\"true\"/></worldbody>", "mocap"},
           {"<asset><hfield name=\"h\" nrow=\"2\" ncol=\"2\" size=\"1 1 1 1\"/></asset><worldbody>"
            "<geom name=\"hills\" type=\"hfield\" hfield=\"h\"/></worldbody>",
            "'hills'"},
           {"<extension><plugin plugin=\"a.b\"/></extension>", "plugins"}}) {
    EXPECT_THAT(complaint(edited_upkie({added(element)})),
                AllOf(MatchesRegex(".*robot.xml:[0-9]+:1: .*"), HasSubstr(words)))
        << element;
  }
}

TEST_F(RefusedRobot, PartsOfTheRobotThatOneEngineAloneWouldSimulateAreNamed) {
  const std::string knee = "<joint name=\"left_knee\"";
  const std::string torso = "<geom name=\"torso\" class=\"collider\" type=\"box\"";
  for (const auto& [edit, words] : std::vector<std::pair<Edit, std::string>>{
           {{knee, knee + " stiffness=\"20\""}, "joint 'left_knee': expected no spring"},
           {{knee, knee + " springdamper=\"0.1 1\""}, "joint 'left_knee': expected no spring"},
           {{"<default>", "<default><joint stiffness=\"3\"/>"}, "expected no spring"},
           {{"<freejoint name=\"root\"/>", "<joint type=\"free\" damping=\"1\"/>"}, "free joint"},
           {{torso, "<geom name=\"torso\" class=\"collider\" type=\"ellipsoid\""}, "geom 'torso'"},
           {{"<site name=\"imu\"",
             "<composite type=\"rope\" count=\"3 1 1\" spacing=\"0.1\"><geom type=\"sphere\" "
             "size=\"0.01\"/></composite><site name=\"imu\""},
            "composite"}}) {
    EXPECT_THAT(complaint(edited_upkie({edit})), HasSubstr(words)) << edit.second;
  }
}

TEST_F(RefusedRobot, ActuatorsThatAreNoMotorsAreNamed) {
  const std::string motor = "<motor name=\"left_hip\" joint=\"left_hip\" ctrlrange=\"-16 16\"/>";
  const std::string names = " name=\"left_hip\" joint=\"left_hip\" ";
  for (const auto& [by, words] : std::vector<Refusal>{
           {"<position" + names + "kp=\"8\" ctrlrange=\"-1 1\"/>", "expected a motor"},
           {"<velocity" + names + "kv=\"1\" ctrlrange=\"-1 1\"/>", "expected a motor"},
           {"<intvelocity" + names + "kp=\"8\" actrange=\"-1 1\"/>", "expected a motor"},
           {"<damper" + names + "kv=\"1\" ctrlrange=\"0 1\"/>", "expected a motor"},
           {"<cylinder" + names + "timeconst=\"1\" ctrlrange=\"-1 1\"/>", "expected a motor"},
           {"<muscle" + names + "ctrlrange=\"0 1\"/>", "expected a motor"},
           {"<general" + names + "dyntype=\"filter\" ctrlrange=\"-1 1\"/>", "activation"},
           {"<motor" + names + "ctrlrange=\"0 16\"/>", "symmetric ctrlrange"},
           {"<motor" + names + "ctrlrange=\"-5 16\"/>", "found -5 to 16"},
           {"<motor" + names + "forcerange=\"-5 16\"/>", "symmetric forcerange"},
           {"<motor" + names + "ctrlrange=\"-1 1\" gear=\"0\"/>", "above 0 N·m"},
           {"<motor" + names + "ctrlrange=\"-16 16\" ctrllimited=\"false\"/>", "ctrlrange"},
           {motor + "<motor name=\"more\" joint=\"left_hip\" ctrlrange=\"-1 1\"/>",
            "actuator 'more'"}}) {
    EXPECT_THAT(complaint(edited_upkie({{motor, by}})), HasSubstr(words)) << by;
  }
}

TEST_F(RefusedRobot, AxesAndShapesThatCannotBeOursAreNamed) {
  const std::string hip = "<joint name=\"left_hip\" axis=\"0 -1 0\"";
  const std::string tyre =
      "<geom name=\"left_tire\" class=\"collider\" type=\"sphere\" size=\"0.05\"";
  for (const auto& [edit, words] : std::vector<std::pair<Edit, std::string>>{
           {{hip, "<joint name=\"left_hip\" axis=\"1 0 0\""},
            "joint 'left_hip': its axis in the base is (1 0 0), expected (0 -1 0)"},
           {{hip, "<joint name=\"left_hip\" axis=\"0 0 1\""}, "its axis in the base is (0 0 1)"},
           {{hip, "<joint name=\"left_hip\" axis=\"1 1 0\""},
            "its axis in the base is (0.707 0.707"},
           {{"pos=\"0 0.1142 -0.164\">", "pos=\"0 0.1142 -0.164\" euler=\"0 0 1.5708\">"},
            "its axis in the base is (1 0 0)"},
           {{tyre,
             "<geom name=\"left_tire\" class=\"collider\" type=\"cylinder\" size=\"0.05 0.01\""},
            "geom 'left_tire': its axis in the base is (0 0 1)"},
           {{tyre,
             "<geom name=\"left_tire\" class=\"collider\" type=\"capsule\" size=\"0.05 0.01\""},
            "geom 'left_tire': its axis in the base is (0 0 1)"},
           {{tyre, "<geom name=\"left_tire\" class=\"collider\" type=\"sphere\" size=\"0.06\""},
            "geom 'right_tire': expected the radius of the other tyre"},
           {{"size=\"0.05\" pos=\"0 -0.046 0\"", "size=\"0.05\" pos=\"0.01 -0.046 0\""},
            "10 mm beside"}}) {
    EXPECT_THAT(complaint(edited_upkie({edit})), HasSubstr(words)) << edit.second;
  }
}

TEST_F(RefusedRobot, AttributesOfLaterVersionsAreNamedAsSuch) {
  const std::string motor = "<motor name=\"left_hip\" joint=\"left_hip\"";
  EXPECT_THAT(
      complaint(edited_upkie({{motor, motor + " dampratio=\"1\""}})),
      AllOf(MatchesRegex(".*robot.xml:[0-9]+:1: .*"), HasSubstr("`dampratio` came with MuJoCo 3")));
  EXPECT_THAT(
      complaint(edited_upkie({{"<body name=\"torso\"", "<body name=\"torso\" gravcomp=\"1\""}})),
      HasSubstr("`gravcomp` came with MuJoCo"));
  EXPECT_THAT(complaint(edited_upkie({added("<worldbody><frame/></worldbody>")})),
              HasSubstr("`frame` came with MuJoCo 3"));
  EXPECT_THAT(complaint(edited_upkie({{motor, motor + " colour=\"red\""}})),
              AllOf(HasSubstr("colour"), Not(HasSubstr("came with"))));
}

TEST_F(RefusedRobot, ErrorsInIncludedFilesAreLocatedThere) {
  folder_.write("more.xml", "<mujoco>\n  <option\n   wind=\"1 0 0\"/>\n</mujoco>\n");
  EXPECT_THAT(complaint(edited_upkie({added("<include file=\"more.xml\"/>")})),
              HasSubstr("more.xml:2:1: option: wind"));
  folder_.write("more.xml",
                "<mujoco><worldbody/>\n<asset>\n<mesh colour=\"red\"/></asset></mujoco>");
  EXPECT_THAT(complaint(edited_upkie({added("<include file=\"more.xml\"/>")})),
              AllOf(HasSubstr("more.xml:3:1:"), HasSubstr("colour")));
  EXPECT_THAT(complaint(edited_upkie({added("<include file=\"nothing.xml\"/>")})),
              HasSubstr("nothing.xml: no such file"));
  folder_.write("more.xml", "<mujoco><include file=\"robot.xml\"/></mujoco>");
  EXPECT_THAT(complaint(edited_upkie({added("<include file=\"more.xml\"/>")})),
              HasSubstr("included already"));
}

TEST_F(RefusedRobot, TooManyGeomsAreRefusedAtOnce) {
  std::string many;
  for (int i = 0; i < 50'000; ++i) many += "<geom class=\"visual\" size=\"0.01\"/>\n";
  EXPECT_THAT(complaint(edited_upkie({{"<site name=\"imu\"", many + "<site name=\"imu\""}})),
              HasSubstr("expected at most 5000 geoms"));
}

TEST_F(RefusedRobot, OtherJointsAndLegsAreNamedWithTheWayOut) {
  EXPECT_THAT(complaint(edited_upkie(
                  {{"<body name=\"left_wheel\"",
                    "<body name=\"ankle\"><inertial pos=\"0 0 0\" mass=\"0.1\" diaginertia=\"1e-4 "
                    "1e-4 1e-4\"/><joint name=\"left_ankle\" axis=\"0 1 "
                    "0\"/><geom size=\"0.01\" mass=\"0.1\"/></body><body "
                    "name=\"left_wheel\""}})),
              AllOf(HasSubstr("joint 'left_ankle'"), HasSubstr("held")));
  EXPECT_THAT(complaint(edited_upkie({{"left_hip", "hip_l"}})),
              AllOf(HasSubstr("expected a hinge joint named 'left_hip'"), HasSubstr("hip_l"),
                    HasSubstr("YAML")));
  EXPECT_THAT(complaint("<robot name=\"a\"><link name=\"b\"/></robot>"),
              AllOf(HasSubstr("<mujoco>"), HasSubstr("YAML file about this URDF")));
}

TEST_F(RefusedRobot, NamesThatTheMjcfDoesNotHaveAreNamed) {
  const std::string upkie = edited_upkie({});
  for (const auto& [yaml, words] : std::vector<Refusal>{
           {"joints: {left_hip: hip_l}\n", "joints.left_hip: expected a joint named 'hip_l'"},
           {"joints: {hip_left: left_hip}\n", "left_hip"},
           {"held: [left_roll]\n", "held: expected a joint named 'left_roll'"},
           {"tyres: {left: rubber}\n", "tyres.left: expected a geom or a body named 'rubber'"},
           {"imu: gyro\n", "imu: expected a site or a body named 'gyro'"},
           {"hip: no\n", "hip"}}) {
    EXPECT_THAT(complaint(upkie, yaml), HasSubstr(words)) << yaml;
  }
  // Joints that are neither servos nor held.
  EXPECT_THAT(complaint(upkie, "hip: none\n"), HasSubstr("joint 'left_hip'"));
}

}  // namespace
}  // namespace touchdown::models
