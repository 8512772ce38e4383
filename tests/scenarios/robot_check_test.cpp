#include "scenarios/robot_check.hpp"

#include <algorithm>
#include <array>
#include <regex>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/resources.hpp"
#include "tests/models/upkie.hpp"
#include "tests/scenarios/runs.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::scenarios {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

class RobotCheckOf : public ::testing::TestWithParam<std::string> {};

TEST_P(RobotCheckOf, AShippedRobotHasNoComplaints) {
  const RobotCheck check = check_robot(GetParam());
  EXPECT_THAT(check.complaints, IsEmpty());
  ASSERT_THAT(check.stands, SizeIs(simulators::simulator_names().size()));
  for (const CheckedStand& stand : check.stands) {
    EXPECT_TRUE(stand.stands) << stand.engine;
    EXPECT_NEAR(stand.load[0] + stand.load[1], 9.81 * check.mass, 0.02 * 9.81 * check.mass);
  }
}

/// In Upkie's crouch, longer shanks below a heavier torso roll half a metre away.
TEST(RobotCheck, AcceptsTheDraftOfLegsOfOtherProportions) {
  const ScratchFolder folder;
  int n = 0;
  for (const auto& [shank, torso, centre] : {std::tuple{"-0.22", "4.2", "-0.011451"},
                                             {"-0.24", "6", "-0.011451"},
                                             {"-0.14", "6", "-0.011451"},
                                             {"-0.175", "4.2", "0.03"}}) {
    std::string text = read_file(upkie_mjcf);
    text = std::regex_replace(text, std::regex("-0\\.175\""), fmt::format("{}\"", shank));
    text = std::regex_replace(text, std::regex("\"2\\.7945\""), fmt::format("\"{}\"", torso));
    text = std::regex_replace(text, std::regex("pos=\"-0\\.011451 "),
                              fmt::format("pos=\"{} ", centre));
    const auto file = folder.write(fmt::format("robot_{}.xml", ++n), text);
    const auto yaml = folder / fmt::format("robot_{}.yaml", n);
    draft_robot(file, yaml);
    EXPECT_THAT(check_robot(yaml).complaints, IsEmpty()) << shank << ' ' << torso << ' ' << centre;
  }
}

TEST(RobotCheck, EndsWhenItIsAskedToStop) {
  EXPECT_THROW(check_robot(upkie_mjcf, [] { return false; }), Stopped);
}

std::vector<std::string> shipped() {
  std::vector<std::string> files;
  for (const char* extension : {".yaml", ".xml"}) {
    for (const auto& file : resources_in("models", extension)) files.push_back(file.string());
  }
  return files;
}

INSTANTIATE_TEST_SUITE_P(All, RobotCheckOf, ::testing::ValuesIn(shipped()),
                         [](const ::testing::TestParamInfo<std::string>& file) {
                           const std::filesystem::path path = file.param;
                           return path.stem().string() + "_" + path.extension().string().substr(1);
                         });

TEST(ARobotCheck, ReadsUpkieAsItIs) {
  const RobotCheck check = check_robot(upkie_mjcf);
  EXPECT_NEAR(check.mass, 5.33922, 1e-5);
  EXPECT_NEAR(check.leg_mass[0], 0.69241 + 0.3954 + 0.18455, 1e-6);
  EXPECT_EQ(check.wheel_radius, 0.05);
  EXPECT_NEAR(check.imu.z(), -0.1, 1e-9);
  ASSERT_THAT(check.joints, SizeIs(6));
  EXPECT_EQ(check.joints[0].axis, Eigen::Vector3d(0.0, -1.0, 0.0));
  EXPECT_EQ(check.joints[0].low, -1.26);
  EXPECT_EQ(check.joints[2].torque_limit, 1.7);
  EXPECT_FALSE(check.joints[2].is_limited);
  // The axle is L₂ sin(knee − hip) behind the knee.
  EXPECT_NEAR(check.lever, 0.175 * std::sin(0.791 - 0.455), 1e-6);
  EXPECT_THAT(check.ignored, IsEmpty());
}

TEST(ARobotCheck, LetsClosedLegsStandAndNamesTheirMotors) {
  const RobotCheck five = check_robot(TOUCHDOWN_SOURCE_DIR "/models/five_bar.yaml");
  EXPECT_THAT(five.complaints, IsEmpty());
  EXPECT_EQ(five.joints[0].actuator, "armature 0.002");
  EXPECT_EQ(five.joints[1].actuator, "motor left_rear_motor, armature 0.002");
  EXPECT_EQ(five.joints[1].torque_limit, 30.0);
  const RobotCheck four = check_robot(TOUCHDOWN_SOURCE_DIR "/models/four_bar.yaml");
  EXPECT_THAT(four.complaints, IsEmpty());
  EXPECT_EQ(four.joints[4].actuator, "no motor");
}

TEST(ARobotCheck, NamesWhatIsReversedAndWhatIsIgnored) {
  const ScratchFolder folder;
  const RobotCheck check = check_robot(folder.write(
      "robot.xml",
      edited_upkie({{"axis=\"0 -1 0\" range", "axis=\"0 1 0\" range"},
                    {"<joint name=\"left_hip\"", "<joint armature=\"0.01\" name=\"left_hip\""},
                    added("<option timestep=\"0.01\"/><sensor><gyro site=\"imu\"/></sensor>")})));
  EXPECT_THAT(check.complaints, IsEmpty());
  EXPECT_TRUE(check.joints[0].is_reversed);
  EXPECT_EQ(check.joints[0].axis, Eigen::Vector3d(0.0, 1.0, 0.0)) << "as in the file";
  EXPECT_FALSE(check.joints[3].is_reversed);
  EXPECT_EQ(check.joints[0].actuator, "armature 0.01");
  EXPECT_THAT(check.ignored, ElementsAre(HasSubstr(": option: "), HasSubstr(": sensor: ")));
  EXPECT_THAT(check.differences, Contains(HasSubstr("armature")));
}

TEST(ARobotCheck, WarnsOfWheelsThatCarryDifferentLoads) {
  const ScratchFolder folder;
  for (const auto& [pattern, by, is_uneven] :
       std::vector<std::tuple<const char*, const char*, bool>>{
           {"left_upper_leg\" pos=\"0 0.1142", "left_upper_leg\" pos=\"0 0.04", true},
           {"right_upper_leg\" pos=\"0 -0.1142", "right_upper_leg\" pos=\"0 -0.05", true},
           {"inertial pos=\"-0.011451 0 ", "inertial pos=\"-0.011451 0.07 ", true},
           {"inertial pos=\"-0.011451 0 ", "inertial pos=\"-0.011451 0.01 ", false}}) {
    const RobotCheck check = check_robot(folder.write("robot.xml", edited_upkie({{pattern, by}})));
    EXPECT_THAT(check.complaints, IsEmpty());
    EXPECT_THAT(check.warnings,
                Contains(AllOf(HasSubstr("different loads, left "), HasSubstr(" N, right ")))
                    .Times(is_uneven ? 1 : 0))
        << by;
  }
}

TEST(ARobotCheck, ComplainsOfRobotsThatCannotBeUsed) {
  const ScratchFolder folder;
  const auto complaints = [&](const std::vector<Edit>& edits) {
    return check_robot(folder.write("robot.xml", edited_upkie(edits))).complaints;
  };
  // Refused, weak, top-heavy on one side, and with a part below the tyres.
  EXPECT_THAT(complaints({added("<tendon/>")}), ElementsAre(HasSubstr("tendon")));
  EXPECT_THAT(complaints({{"-16 16\"", "-0.1 0.1\""}}),
              ElementsAre(AllOf(HasSubstr("mujoco: standing: fell"), HasSubstr("torque limit")),
                          AllOf(HasSubstr("bullet: standing: fell"), HasSubstr("torque limit"))));
  EXPECT_THAT(complaints({{"-1.7 1.7\"", "-0.1 0.1\""}}),
              ElementsAre(AllOf(HasSubstr("mujoco: standing: fell"), HasSubstr("gains: lqr")),
                          AllOf(HasSubstr("bullet: standing: fell"), HasSubstr("gains: lqr"))));
  EXPECT_THAT(complaints({{"<inertial pos=\"-0.011451 0 -0.118768\"",
                           "<inertial pos=\"-0.011451 0.3 -0.118768\""}}),
              Contains(HasSubstr("standing:")));
  EXPECT_THAT(complaints({{"<geom name=\"left_tire\"",
                           "<geom class=\"collider\" type=\"sphere\" size=\"0.07\" pos=\"0 -0.046 "
                           "0\"/><geom name=\"left_tire\""}}),
              Contains(AllOf(HasSubstr("mujoco: "),
                             HasSubstr("a part other than a tyre touched the "
                                       "terrain: 'left_wheel'"),
                             HasSubstr("no_collision: [left_wheel]"))));
}

TEST(ARobotCheck, NamesTheCauseOfAFallBeforeItsRemedies) {
  const ScratchFolder folder;
  const std::string left = "(joint=\"left_knee\") ctrlrange=\"-16 16\"";
  const std::string right = "(joint=\"right_knee\") ctrlrange=\"-16 16\"";
  // Half the weight, 26.2 N, at the axle's distance from the knee, .0577 m.
  const std::string needs = "_knee' needs 1.51 N·m, and its torque limit is ";
  for (const auto& [edits, keys, words] :
       std::vector<std::tuple<std::vector<Edit>, std::string, std::string>>{
           {{{left, "$1 ctrlrange=\"-1 1\""}}, "", "'left" + needs + "1 N·m"},
           {{{right, "$1 ctrlrange=\"-9 9\" forcerange=\"-.7 .7\""}},
            "",
            "'right" + needs + "0.7 N·m"},
           {{{left, "$1 ctrlrange=\"-16 16\" gear=\".05\""}}, "", "'left" + needs + "0.8 N·m"},
           {{}, "actuators: {knee: {maximum_torque: 0.9}}\n", "'left" + needs + "0.9 N·m"},
           {{}, "mass: 100\n", "or the mass of 533.9 kg"},
           {{{"pos=\"0 (-?)0.1142 -0.164\"", "pos=\"0 $010.1142 0\" quat=\"0 1 0 0\""}},
            "",
            "z axis point down?"}}) {
    folder.write("robot.xml", edited_upkie(edits));
    EXPECT_THAT(
        check_robot(folder.write("robot.yaml", "mjcf: robot.xml\n" + keys)).complaints,
        AllOf(SizeIs(2), Each(AllOf(HasSubstr("standing: fell"), HasSubstr(words),
                                    Not(HasSubstr("no_collision")), Not(HasSubstr("gains"))))))
        << words;
  }
  for (const char* limit : {"3", "2.5"}) {
    const std::string both = std::string("$1 ctrlrange=\"-") + limit + " " + limit + "\"";
    const RobotCheck check =
        check_robot(folder.write("robot.xml", edited_upkie({{left, both}, {right, both}})));
    EXPECT_THAT(check.warnings, ElementsAre(HasSubstr("mujoco: dropped from 10 cm: fell"),
                                            HasSubstr("bullet: dropped from 10 cm: fell")));
    EXPECT_THAT(check.warnings, Each(HasSubstr("touched the terrain: '")));
  }
}

TEST(ARobotCheck, NamesRangesThatLockTheLegsAndAnImuFarAway) {
  const ScratchFolder folder;
  const auto complaints = [&](const std::vector<Edit>& edits) {
    return check_robot(folder.write("robot.xml", edited_upkie(edits))).complaints;
  };
  const auto ranges = [](const std::string& joint, const char* left, const char* right) {
    return std::vector<Edit>{
        {"(\"left_" + joint + "\" axis=\"0 -1 0\" range)=\"[^\"]*", std::string("$1=\"") + left},
        {"(\"right_" + joint + "\" axis=\"0 1 0\" range)=\"[^\"]*", std::string("$1=\"") + right}};
  };
  EXPECT_THAT(complaints({{"angle=\"radian\"", "angle=\"degree\""}}),
              AllOf(SizeIs(4), Each(HasSubstr("radians where the file has degrees")),
                    Contains(HasSubstr("joint 'right_knee': its range is 0.0876 rad wide, 5°"))));
  EXPECT_THAT(complaints(ranges("knee", "0 0.05", "-2.51 2.51")),
              Contains(HasSubstr("joint 'left_knee': its range")));
  for (const auto& [joint, left, right] :
       std::vector<std::array<const char*, 3>>{{"knee", "-2.51 0", "-2.51 0"},
                                               {"knee", "0.1 2", "0 2"},
                                               {"hip", "0.2 1.26", "0.2 1.26"}}) {
    EXPECT_THAT(complaints(ranges(joint, left, right)),
                Contains(HasSubstr("the legs cannot bend alike")));
  }
  EXPECT_THAT(complaints(ranges("knee", "-2.51 0", "0 2.51")), IsEmpty());
  for (const char* place : {"0 0 5", "-3 0 0", "0 57 0"}) {
    const std::string site = std::string("name=\"imu\" pos=\"") + place + "\"";
    EXPECT_THAT(complaints({{"name=\"imu\" pos=\"0 0 -0.1\"", site}}),
                Contains(HasSubstr("IMU: expected it on the base")));
  }
}

/// The check of a shipped robot with another base (kg), other rotors (kg·m²), and more keys.
RobotCheck check_of(double base, double armature, const std::string& gains = "") {
  const ScratchFolder folder;
  const std::string urdf = read_file(TOUCHDOWN_SOURCE_DIR "/models/legs/ros_style.urdf");
  folder.write("robot.urdf", std::regex_replace(urdf, std::regex("<mass value=\"5\"/>"),
                                                fmt::format("<mass value=\"{}\"/>", base)));
  const std::string yaml = read_file(TOUCHDOWN_SOURCE_DIR "/models/ros_style.yaml");
  const std::string mine =
      std::regex_replace(std::regex_replace(yaml, std::regex("legs/ros_style.urdf"), "robot.urdf"),
                         std::regex("gains: lqr"), "gains: lqr" + gains);
  std::string actuators = "actuators:\n";
  for (const char* joint : {"hip", "knee", "wheel"}) {
    actuators += fmt::format("  {}: {{armature: {}}}\n", joint, armature);
  }
  return check_robot(folder.write("robot.yaml", mine + actuators));
}

TEST(ARobotCheck, FindsNoLimitCycleWithDerivedGainsInEitherEngine) {
  for (const auto& [base, armature] : std::vector<std::pair<double, double>>{
           {4, 0}, {14, 0}, {20, 0.05}, {9, 0.012}, {31, 0.004}}) {
    const RobotCheck check = check_of(base, armature);
    EXPECT_THAT(check.complaints, Each(Not(HasSubstr("cycle")))) << base << ' ' << armature;
    EXPECT_THAT(check.stands, SizeIs(2));
    EXPECT_GT(std::min(check.margins.flight, check.margins.standing), 1.24);
  }
}

TEST(ARobotCheck, ComplainsOfGainsWithALimitCycleInBothEngines) {
  const auto cycle = [](const std::string& engine, const std::string& joint) {
    return Contains(AllOf(HasSubstr(engine + ": dropped from 10 cm"), HasSubstr(joint),
                          HasSubstr("changes its sign in most records")));
  };
  for (const auto& [gains, joint] : std::vector<std::pair<const char*, const char*>>{
           {", leg_kd_scale: 16", "left_hip"}, {", wheel_kd_scale: 3", "right_wheel"}}) {
    const RobotCheck check = check_of(11, 0, gains);
    EXPECT_LT(check.margins.flight, 1.0);
    EXPECT_THAT(check.complaints, Contains(HasSubstr("servos: unstable at this physics step")));
    EXPECT_THAT(check.complaints, AllOf(cycle("mujoco", joint), cycle("bullet", joint)));
  }
}

}  // namespace
}  // namespace touchdown::scenarios
