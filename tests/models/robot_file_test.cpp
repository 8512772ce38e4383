#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/robot_model.hpp"
#include "models/stance.hpp"
#include "tests/complaint.hpp"
#include "tests/models/upkie.hpp"
#include "tests/models/urdf_biped.hpp"
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

TEST_F(FoundFile, OfMuJoCo3NamesWhatTouchdownOverridesOrDraws) {
  const std::string material = "<material name=\"wood\"";
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

TEST_F(FoundFile, HasAtMostFiveThousandGeoms) {
  std::string many;
  for (int i = 0; i < 50'000; ++i) many += "<geom class=\"visual\" size=\"0.01\"/>\n";
  EXPECT_THAT(complaint_of([&] {
                (void)robot({{"<site name=\"imu\"", many + "$&"}});
              }),
              HasSubstr("expected at most 5000 geoms"));
}

TEST_F(FoundFile, MayDriveItsJointsInTheParentsFrame) {
  const RobotModel robot = this->robot(
      {{hip_motor, "<motor name=\"actuator1\" jointinparent=\"left_hip\" ctrlrange=\"-7 7\""}});
  EXPECT_EQ(robot.effort[left_hip], 7.0);
}

TEST_F(FoundFile, HasTorqueLimitsFromTheYamlFileWhereItHasNone) {
  const std::string servo = "<position name=\"left_hip\" joint=\"left_hip\" kp=\"8\"";
  const std::vector<Edit> edits = {{hip_motor, servo}};
  EXPECT_EQ(robot(edits, "actuators: {hip: {maximum_torque: 7}}\n").effort[left_hip], 7.0);
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
  const std::string slides =
      "<joint name=\"x\" type=\"slide\" axis=\"1 0 0\"/><joint type=\"slide\" axis=\"0 0 1\"/>";
  for (const std::string& joints :
       {std::string(), slides, slides + "<joint axis=\"0 1 0\"/>",
        slides + "<joint type=\"ball\"/>", std::string("<joint axis=\"0 1 0\"/>")}) {
    const RobotModel floating = robot({{"<freejoint name=\"root\"/>", joints}});
    EXPECT_GE(floating.base_body, 1);
    EXPECT_EQ(floating.mj->nv, 12) << joints;
    EXPECT_THAT(floating.ignored,
                Contains(AllOf(HasSubstr("body 'torso'"), HasSubstr("to the world: it floats"))));
  }
  const auto joint = [](const std::string& parent, const std::string& type,
                        const std::string& child) {
    return fmt::format(
        "<link name=\"{0}\"/><joint name=\"of_{0}\" type=\"{1}\"><parent link=\"{0}\"/><child "
        "link=\"{2}\"/><axis xyz=\"0 0 1\"/><limit lower=\"-1\" upper=\"1\" effort=\"1\"/></joint>",
        parent, type, child);
  };
  for (const std::string& joints :
       {joint("world", "planar", "base"), joint("world", "prismatic", "base"),
        joint("footprint", "revolute", "base"), joint("world", "floating", "base"),
        joint("world", "fixed", "base"),
        joint("world", "prismatic", "cart") + joint("cart", "continuous", "base"),
        joint("world", "fixed", "cart") + joint("cart", "planar", "base")}) {
    EXPECT_EQ(written(urdf_biped(joints), "mass: 1\n", "robot.urdf").mj->nv, 12) << joints;
  }
}

TEST_F(FoundFile, HasFiniteDecimalNumbersAlone) {
  for (const auto& one : std::vector<std::pair<Edit, std::string>>{
           {{"range=\"-2.51 2.51\"", "range=\"-2.51 nan\""},
            "robot.xml:68:11: joint 'left_knee': range: expected finite decimal numbers, found "
            "'nan'"},
           {{"mass=\"0.69241\"", "mass=\"inf\""}, "inertial: mass: expected"},
           {{"axis=\"0 -1 0\"", "axis=\"0 -NaN 0\""}, "axis: expected"},
           {{"pos=\"0 0 -0.1\"", "pos=\"0 0 -Infinity\""}, "pos: expected"},
           {{"ctrlrange=\"-16 16\"", "ctrlrange=\"-16 0x10\""}, "found '0x10'"}}) {
    EXPECT_THAT(complaint_of([&] { (void)robot({one.first}); }), HasSubstr(one.second));
  }
  EXPECT_GT(robot({{"\"wood\"", "\"nan\""}}).wheel_radius, 0.0) << "a name is no number";
  for (const auto& one : std::vector<std::pair<Edit, std::string>>{
           {{"xyz=\"0 0.1 0\"", "xyz=\"0 nan 0\""}, "origin: xyz: expected"},
           {{"xyz=\"0 0.1 0\"", "xyz=\"0 0x1 0\""}, "origin: xyz: expected"},
           {{"xyz=\"0 0.1 0\"", "xyz=\"inf 0.1 0\""}, "origin: xyz: expected"},
           {{"xyz=\"0 0.1 0\"", "xyz=\"\""}, "xyz: expected three numbers"},
           {{"xyz=\"0 0.1 0\"", "xyz=\"0 0.1\""}, "found '0 0.1'"},
           {{"xyz=\"0 0.1 0\"", "xyz=\"0, 0.1, 0\""}, "found '0, 0.1, 0'"},
           {{"xyz=\"0 0.1 0\"", "xyz=\"0 0.1m 0\""}, "joint 'left_hip': origin: xyz: expected"},
           {{"axis xyz=\"0 1 0\"", "axis xyz=\"0 1\""}, "axis: xyz: expected three numbers"},
           {{"effort=\"20\"", "effort=\"20 N\""}, "limit: effort: expected a number"},
           {{"mass value=\"1\"", "mass value=\"1kg\""}, "link 'base': mass: value: expected"},
           {{"ixx=\".01\"", "ixx=\",01\""}, "inertia: ixx: expected a number, found ',01'"},
           {{"radius=\".06\"", "radius=\"\""}, "sphere: radius: expected a number, found ''"}}) {
    EXPECT_THAT(complaint_of([&] {
                  (void)written(edited(urdf_biped(), {one.first}), "mass: 1\n", "robot.urdf");
                }),
                AllOf(HasSubstr("robot.urdf:1:"), HasSubstr(one.second)));
  }
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

TEST_F(FoundFile, MayBeAUrdfWithTheNamesOfTheContract) {
  const RobotModel named = written(urdf_biped(), "base: base\n", "robot.urdf");
  EXPECT_EQ(named.effort[left_knee], 20.0);
  EXPECT_EQ(named.wheel_radius, 0.06);
  const RobotModel alone =
      compile_robot_model(folder_.write("biped.urdf", urdf_biped()), Terrain{});
  EXPECT_EQ(alone.effort, named.effort);
}

TEST_F(FoundFile, MayBeAUrdfWithASectionOfMuJoCo) {
  for (const char* section :
       {"<mujoco><compiler meshdir=\"m\" fusestatic=\"true\" discardvisual=\"true\"/></mujoco>",
        "<mujoco><compiler angle=\"degree\" strippath=\"true\"/><option gravity=\"0 0 0\"/>"
        "<size njmax=\"9\"/></mujoco><mujoco/>",
        "<mujoco><compiler balanceinertia=\"true\" saveinertial=\"true\"/></mujoco>"}) {
    const RobotModel robot = written(urdf_biped(section), "mass: 1\n", "robot.urdf");
    EXPECT_NEAR(mj_getTotalmass(robot.mj.get()), 8.0, 1e-9) << section;
    EXPECT_THAT(robot.ignored, Contains(HasSubstr("mujoco: "))) << section;
  }
  EXPECT_NEAR(mj_getTotalmass(written(urdf_biped("<mujoco><compiler settotalmass=\"4\"/></mujoco>"),
                                      "mass: 1\n", "robot.urdf")
                                  .mj.get()),
              4.0, 1e-6);
}

TEST_F(FoundFile, MayBeAUrdfWithoutItsMeshes) {
  const auto with_mesh = [&](const std::string& file) {
    return written(urdf_biped("", "<collision><geometry><mesh filename=\"" + file +
                                      "\"/></geometry></collision>"),
                   "mass: 1\n", "robot.urdf")
        .ignored;
  };
  EXPECT_THAT(with_mesh("../meshes/base.stl"),
              Contains(AllOf(HasSubstr("'../meshes/base.stl'"), HasSubstr("link 'base'"))));
  EXPECT_THAT(with_mesh("package://my_robot/meshes/base.stl"),
              Contains(HasSubstr("ros2 pkg prefix --share my_robot)/meshes/base.stl")));
}

}  // namespace
}  // namespace touchdown::models
