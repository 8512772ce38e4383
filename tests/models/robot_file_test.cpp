#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "models/robot_model.hpp"
#include "models/stance.hpp"
#include "tests/complaint.hpp"
#include "tests/models/upkie.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::models {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::size_t left_hip = index(Servo::left_hip);
constexpr std::size_t left_knee = index(Servo::left_knee);

/// Files as their owners have them.
class FoundFile : public ::testing::Test {
 protected:
  RobotModel robot(const std::vector<Edit>& edits, const std::string& keys = "mass: 1\n") {
    return written(edited_upkie(edits), keys);
  }
  RobotModel written(const std::string& text, const std::string& keys = "mass: 1\n",
                     const std::string& name = "robot.xml") {
    folder_.write(name, text);
    return compile_robot_model(folder_.write("robot.yaml", fmt::format("mjcf: {}\n{}", name, keys)),
                               Terrain{});
  }
  ScratchFolder folder_;
};

const std::string hip_joint = "<joint name=\"left_hip\"";
const std::string hip_motor = "<motor name=\"left_hip\" joint=\"left_hip\" ctrlrange=\"-16 16\"";
const std::string imu_site = "<site name=\"imu\"";

TEST_F(FoundFile, OfMuJoCo3IsReadWhereTouchdownOverridesOrDrawsIt) {
  const std::string servo = "<position name=\"left_hip\" joint=\"left_hip\" kp=\"9\" ";
  const std::string general = "<general name=\"left_hip\" joint=\"left_hip\" ctrlrange=\"-1 1\" ";
  const std::string camera = "<camera name=\"eye\" ";
  const std::string compiler = "<compiler angle=\"radian\"";
  const std::string root = "<freejoint name=\"root\"";
  const std::string material = "<material name=\"wood\"";
  for (const Edit& edit : std::vector<Edit>{
           {compiler, compiler + " assetdir=\".\" alignfree=\"true\" saveinertial=\"true\""},
           {hip_joint, hip_joint + " actuatorgravcomp=\"true\""},
           {hip_motor, general + "actdim=\"2\" actearly=\"true\""},
           {hip_motor, servo + "kv=\"1\" forcerange=\"-9 9\""},
           {hip_motor, servo + "dampratio=\"1\" forcerange=\"-9 9\""},
           {hip_motor, servo + "timeconst=\"1\" inheritrange=\"1\" forcerange=\"-9 9\""},
           {imu_site, camera + "resolution=\"8 8\" sensorsize=\"1 1\" orthographic=\"true\"/>$&"},
           {imu_site, "<light bulbradius=\"0.1\"/>$&"},
           {imu_site,
            "<frame name=\"f\"><frame><geom class=\"visual\" size=\".1\"/></frame></frame>$&"},
           {material, material + " metallic=\"1\" roughness=\"1\""},
           {root, root + " align=\"false\""},
           {"<asset>", "<asset><texture name=\"t\" content_type=\"image/png\" file=\"t.png\"/>"},
           {"<asset>",
            "<asset><mesh name=\"m\" maxhullvert=\"9\" vertex=\"0 0 0 1 0 0 0 1 0 0 0 1\"/>"},
           {"<default>", "<default><position dampratio=\"1\" kv=\"2\"/>"},
           {"<body name=\"torso\"", "$& gravcomp=\"0\""},
           added("<option gravity=\"0 0 0\" wind=\"1 0 0\" sdf_iterations=\"3\"><flag "
                 "contact=\"disable\" invdiscrete=\"enable\"/></option>"),
           added("<sensor><rangefinder site=\"imu\" data=\"dist\"/></sensor>"),
           added("<keyframe><key qpos=\"0\" mpos=\"1\"/></keyframe>"),
           added("<visual><global cameraid=\"1\"/></visual>"),
           added("<worldbody><geom name=\"table\" type=\"box\" size=\"1 1 1\"/></worldbody>"),
           added("<worldbody><body name=\"rack\"><geom size=\"1\"/></body></worldbody>"),
           added("<worldbody><body name=\"hand\" mocap=\"true\"/></worldbody>")}) {
    EXPECT_EQ(complaint_of([&] { (void)robot({edit}); }), "no complaint") << edit.second;
  }
  EXPECT_THAT(robot({{material, material + " metallic=\"1\""}}).ignored,
              Contains(AllOf(HasSubstr("'wood'"), HasSubstr("metallic"))));
  EXPECT_THAT(robot({added("<option gravity=\"0 0 -1.62\"/>")}).ignored,
              Contains(HasSubstr("gravity")));
}

TEST_F(FoundFile, LimitsTorquesByItsJointsAsMuJoCo3Does) {
  const std::string range = " actuatorfrcrange=\"-9 9\"";
  const auto effort = [&](const std::vector<Edit>& edits) { return robot(edits).effort[left_hip]; };
  EXPECT_EQ(effort({{hip_joint, hip_joint + range}}), 9.0);
  EXPECT_EQ(effort({{hip_joint, hip_joint + " actuatorforcerange=\"-9 9\""}}), 9.0);
  EXPECT_EQ(effort({{hip_joint, hip_joint + range + " actuatorfrclimited=\"false\""}}), 16.0);
  EXPECT_EQ(effort({{hip_joint, hip_joint + " actuatorfrcrange=\"-20 20\""}}), 16.0);
  EXPECT_EQ(effort({{hip_joint, hip_joint + range}, {hip_motor, hip_motor + " gear=\"-3\""}}), 9.0);
  EXPECT_EQ(effort({{"<default>", "<default><joint" + range + "/>"}}), 9.0);
  EXPECT_EQ(effort({{hip_joint, hip_joint + range}, {hip_motor + "/>", ""}}), 9.0);
  EXPECT_EQ(written(rolling_upkie("actuatorfrcrange=\"-5 5\""), "held: [left_roll, right_roll]\n")
                .held[0]
                .effort,
            5.0);
  EXPECT_EQ(effort({{hip_joint, hip_joint + range},
                    {hip_motor, "<position name=\"left_hip\" joint=\"left_hip\" kp=\"8\""}}),
            9.0);
}

TEST_F(FoundFile, MayDriveItsJointsInTheParentsFrame) {
  const RobotModel robot = this->robot(
      {{hip_motor, "<motor name=\"actuator1\" jointinparent=\"left_hip\" ctrlrange=\"-7 7\""}});
  EXPECT_EQ(robot.effort[left_hip], 7.0);
  EXPECT_EQ(robot.mj->nu, 6);
}

TEST_F(FoundFile, HasTorqueLimitsFromTheYamlFileWhereItHasNone) {
  const std::string servo = "<position name=\"left_hip\" joint=\"left_hip\" kp=\"8\"";
  const std::vector<Edit> edits = {{hip_motor, servo}};
  EXPECT_EQ(robot(edits, "actuators: {hip: {maximum_torque: 7}}\n").effort[left_hip], 7.0);
  EXPECT_THAT(complaint_of([&] { (void)robot(edits); }),
              AllOf(HasSubstr("forcerange"), HasSubstr("actuators: {hip: {maximum_torque")));
}

TEST_F(FoundFile, KeepsTheDampingOfPositionServosThatHoldJoints) {
  const std::string keys = "held: [left_roll, right_roll]\n";
  const std::string start = "<position joint=\"{0}_roll\" kp=\"150\" forcerange=\"-40 40\" ";
  const RobotModel damped = written(rolling_upkie("", start + "kv=\"7\"/>"), keys);
  EXPECT_EQ(damped.held[0].kp, 150.0);
  EXPECT_EQ(damped.held[0].kd, 7.0);
  EXPECT_EQ(damped.held[0].effort, 40.0);
  const RobotModel ratio = written(rolling_upkie("", start + "dampratio=\"1\"/>"), keys);
  EXPECT_EQ(ratio.held[0].kp, 150.0);
}

/// Upkie on a base body that is turned against its torso.
std::vector<Edit> turned(double yaw) {
  return {{"<body name=\"torso\"([^>]*)>\\s*(<inertial[^>]*>)\\s*<freejoint name=\"root\"/>",
           fmt::format("<body name=\"plate\" $1><freejoint/><inertial pos=\"0 0 0\" mass=\"0.01\" "
                       "diaginertia=\"1e-5 1e-5 1e-5\"/><geom name=\"plate\" type=\"box\" "
                       "size=\".01 .02 .01\" pos=\".03 0 0\" mass=\"0\"/><body name=\"torso\" "
                       "euler=\"0 0 {}\">$2",
                       yaw)},
          {"</body>\\s*</worldbody>", "</body></body></worldbody>"}};
}

TEST_F(FoundFile, MayHaveABaseThatFacesElsewhere) {
  const RobotModel straight = robot(turned(0.0));
  EXPECT_THAT(straight.ignored, Not(Contains(HasSubstr("forward"))));
  const double quarter = 0.5 * M_PI;
  for (const auto& [yaw, keys, forward] : std::vector<std::tuple<double, std::string, std::string>>{
           {quarter, "", "y"},
           {-quarter, "", "-y"},
           {quarter, "forward: y\n", "y"},
           {2.0 * quarter, "forward: -x\n", "-x"},
           {0.0, "forward: x\n", "x"},
           {-quarter, "tyre: {law: spring_damper, width: 0.04}\n", "-y"}}) {
    const RobotModel robot = this->robot(turned(yaw), "mass: 1\n" + keys);
    EXPECT_THAT(robot.ignored,
                Contains(HasSubstr("it faces " + forward + ",")).Times(forward == "x" ? 0 : 1));
    EXPECT_EQ(robot.joint_name[left_hip], "left_hip");
    EXPECT_LT((robot.imu_position - straight.imu_position).norm(), 1e-9);
    const MjDataPtr expected = at_zero(straight);
    const MjDataPtr found = at_zero(robot);
    for (std::size_t i = 0; i < servo_count; ++i) {
      const int own = robot.joint[i];
      const int other = straight.joint[i];
      EXPECT_LT((vector_at(found->xanchor, own) - vector_at(expected->xanchor, other)).norm(),
                1e-9);
      EXPECT_LT((vector_at(found->xaxis, own) - vector_at(expected->xaxis, other)).norm(), 1e-9);
    }
    const int plate = mj_name2id(robot.mj.get(), mjOBJ_GEOM, "plate");
    EXPECT_NEAR(vector_at(found->geom_xpos, plate).norm(), 0.03, 1e-9);
    EXPECT_NEAR(std::abs(found->geom_xpos[3 * plate]), std::abs(0.03 * std::cos(yaw)), 1e-9);
  }
  EXPECT_EQ(robot(turned(2.0 * quarter)).joint_name[left_hip], "right_hip")
      << "sides, not the base";
}

TEST_F(FoundFile, MayHaveMeshesAsWheels) {
  const std::string tyre = "type=\"sphere\" size=\"0.05\" pos=\"0 -?0.046 0\"";
  const std::vector<Edit> edits = {{tyre, "type=\"box\" size=\"0.05 0.02 0.05\""},
                                   {"left_tire", "block"},
                                   {"right_tire", "clog"}};
  const RobotModel robot = this->robot(edits, "tyres: {radius: 0.07}\n");
  EXPECT_EQ(robot.wheel_radius, 0.07);
  for (std::size_t wheel = 0; wheel < wheel_count; ++wheel) {
    const int geom = robot.tyre_geom[wheel];
    EXPECT_EQ(robot.mj->geom_type[geom], mjGEOM_SPHERE);
    // The wheels turn about y, and their mass is 35.5 mm outside of the joint.
    EXPECT_NEAR(std::abs(robot.mj->geom_pos[3 * geom + 1]), 0.035535, 1e-9);
  }
  EXPECT_EQ(robot.mj->geom_contype[mj_name2id(robot.mj.get(), mjOBJ_GEOM, "block")], 0);
  EXPECT_THAT(complaint_of([&] { (void)this->robot(edits); }),
              HasSubstr("expected a sphere, cylinder or capsule"));
}

TEST_F(FoundFile, LeavesOutTheCollidersThatAreNamed) {
  const auto touches = [](const RobotModel& robot) {
    return robot.mj->geom_contype[mj_name2id(robot.mj.get(), mjOBJ_GEOM, "torso")] != 0;
  };
  EXPECT_TRUE(touches(robot({})));
  EXPECT_FALSE(touches(robot({}, "no_collision: [torso]\n")));
  EXPECT_FALSE(touches(
      robot({{"<body name=\"torso\"", "<body name=\"trunk\""}}, "no_collision: [trunk]\n")));
}

TEST_F(FoundFile, FloatsWhereItIsFixedToTheWorld) {
  const Edit fixed = {"<freejoint name=\"root\"/>", ""};
  const RobotModel floating = robot({fixed});
  EXPECT_GE(floating.base_body, 1);
  EXPECT_THAT(floating.ignored, Contains(AllOf(HasSubstr("body 'torso'"), HasSubstr("floats"))));
  EXPECT_THAT(complaint_of([&] {
                (void)robot({fixed, added("<worldbody><body name=\"leg\"><joint/><geom "
                                          "size=\".1\"/></body></worldbody>")});
              }),
              AllOf(HasSubstr("body 'torso'"), HasSubstr("<freejoint/>")));
}

TEST_F(FoundFile, StandsWithinTheRangesOfItsJoints) {
  const auto stance = [&](const std::string& hip, const std::string& knee) {
    const auto limited = [](const std::string& name, const std::string& range) {
      return Edit{fmt::format("<joint name=\"{}\"([^>]*) range=\"[^\"]*\"", name),
                  fmt::format("<joint name=\"{}\"$1 range=\"{}\"", name, range)};
    };
    const RobotModel found = robot({limited("left_hip", hip), limited("right_hip", hip),
                                    limited("left_knee", knee), limited("right_knee", knee)});
    EXPECT_FALSE(stance_error(found, usual_stance(found)));
    return usual_stance(found);
  };
  EXPECT_EQ(stance("-1.26 1.26", "-2.51 2.51").knee, Stance().knee);
  // The left knee's angle is negative where it bends backward; symmetric ranges fit both legs.
  EXPECT_NEAR(std::abs(stance("-1.26 1.26", "-0.5 0.5").knee), 0.44, 0.03);
  EXPECT_NEAR(std::abs(stance("-0.3 0.3", "-2.5 2.5").knee), Stance().knee, 0.1);
  EXPECT_LT(std::abs(stance("-0.3 0.3", "-2.5 2.5").hip), 0.3);
}

std::string link(const std::string& name, const std::string& more = "") {
  return fmt::format(
      "<link name=\"{}\"><inertial><mass value=\"1\"/><inertia ixx=\".01\" "
      "iyy=\".01\" izz=\".01\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial>{}</link>",
      name, more);
}

/// A wheeled biped in a URDF with the names of the contract.
std::string biped(const std::string& more = "", const std::string& base = "") {
  std::string text = "<robot name=\"biped\">" + more + link("base", base) + link("imu") +
                     "<joint name=\"imu\" type=\"fixed\"><parent link=\"base\"/><child "
                     "link=\"imu\"/></joint>";
  for (const auto& [side, y] : {std::pair("left", 0.1), std::pair("right", -0.1)}) {
    std::string parent = "base";
    for (const char* part : {"hip", "knee", "wheel"}) {
      const std::string name = fmt::format("{}_{}", side, part);
      const bool is_wheel = std::string_view(part) == "wheel";
      text += link(name, is_wheel ? "<collision><geometry><sphere radius=\".06\"/></geometry>"
                                    "</collision>"
                                  : "");
      text += fmt::format(
          "<joint name=\"{0}\" type=\"continuous\"><origin xyz=\"0 {1} {2}\"/><parent "
          "link=\"{3}\"/><child link=\"{0}\"/><axis xyz=\"0 1 0\"/><limit effort=\"20\" "
          "velocity=\"9\"/></joint>",
          name, parent == "base" ? y : 0.0, parent == "base" ? 0.0 : -0.2, parent);
      parent = name;
    }
  }
  return text + "</robot>";
}

TEST_F(FoundFile, MayBeAUrdfWithTheNamesOfTheContract) {
  const RobotModel named = written(biped(), "base: base\n", "robot.urdf");
  EXPECT_EQ(named.effort[left_knee], 20.0);
  EXPECT_EQ(named.wheel_radius, 0.06);
  const RobotModel alone = compile_robot_model(folder_.write("biped.urdf", biped()), Terrain{});
  EXPECT_EQ(alone.effort, named.effort);
}

TEST_F(FoundFile, MayBeAUrdfWithASectionOfMuJoCo) {
  for (const char* section :
       {"<mujoco><compiler meshdir=\"m\" fusestatic=\"true\" discardvisual=\"true\"/></mujoco>",
        "<mujoco><compiler angle=\"degree\" strippath=\"true\"/><option gravity=\"0 0 0\"/>"
        "<size njmax=\"9\"/></mujoco><mujoco/>",
        "<mujoco><compiler balanceinertia=\"true\" saveinertial=\"true\"/></mujoco>"}) {
    const RobotModel robot = written(biped(section), "mass: 1\n", "robot.urdf");
    EXPECT_NEAR(mj_getTotalmass(robot.mj.get()), 8.0, 1e-9) << section;
    EXPECT_THAT(robot.ignored, Contains(HasSubstr("mujoco: "))) << section;
  }
  EXPECT_NEAR(mj_getTotalmass(written(biped("<mujoco><compiler settotalmass=\"4\"/></mujoco>"),
                                      "mass: 1\n", "robot.urdf")
                                  .mj.get()),
              4.0, 1e-6);
}

TEST_F(FoundFile, IsNoUrdfOfTwoRobots) {
  const std::string mass =
      "<inertial><mass value=\"3\"/><inertia ixx=\".1\" iyy=\".1\" izz=\".1\" "
      "ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial>";
  const auto complaint = [&](const std::string& link, const std::string& keys) {
    std::string text = biped();
    text.insert(text.find("</robot>"), link);
    return complaint_of([&] { (void)written(text, keys, "robot.urdf"); });
  };
  for (const std::string keys : {"mass: 1\n", "base: base\n"}) {
    EXPECT_THAT(complaint("<link name=\"rock\">" + mass + "</link>", keys),
                HasSubstr("link 'rock': expected a joint with this child: 'base' is the root"));
    EXPECT_EQ(complaint("<link name=\"map\"/>", keys), "no complaint");
  }
}

TEST_F(FoundFile, MayBeAUrdfWithoutItsMeshes) {
  const auto with_mesh = [&](const std::string& file) {
    return written(biped("", "<collision><geometry><mesh filename=\"" + file +
                                 "\"/></geometry></collision>"),
                   "mass: 1\n", "robot.urdf")
        .ignored;
  };
  EXPECT_THAT(with_mesh("../meshes/base.stl"),
              Contains(AllOf(HasSubstr("'../meshes/base.stl'"), HasSubstr("link 'base'"))));
  EXPECT_THAT(with_mesh("package://my_robot/meshes/base.stl"),
              Contains(HasSubstr("ros2 pkg prefix --share my_robot)/meshes/base.stl")));
  EXPECT_THAT(complaint_of([&] {
                (void)written(biped("<link name=\"hat\"><collision><geometry><mesh "
                                    "filename=\"a.stl\"/></geometry></collision></link>"),
                              "mass: 1\n", "robot.urdf");
              }),
              AllOf(HasSubstr("a.stl"), HasSubstr("<inertial>")));
}

TEST_F(FoundFile, OfXacroIsNamedWithItsCommand) {
  const std::string text = "<robot xmlns:xacro=\"x\"><xacro:include filename=\"a\"/>" + link("b");
  EXPECT_THAT(complaint_of([&] {
                (void)compile_robot_model(folder_.write("my.urdf.xacro", text + "</robot>"),
                                          Terrain{});
              }),
              AllOf(HasSubstr("`xacro my.urdf.xacro > "), Not(HasSubstr("> my.urdf.xacro"))));
}

}  // namespace
}  // namespace touchdown::models
