#include <fmt/format.h>

#include "estimator/force/linkage.hpp"
#include "models/robot_model.hpp"
#include "tests/complaint.hpp"
#include "tests/models/upkie.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::models {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// A leg with a motor at the hip that drives the knee: thigh, crank, rod and shank are a
/// parallelogram, so that the shank stays parallel to the crank.
std::string parallel_leg(const std::string& side, double y) {
  return fmt::format(
      R"(
<body name="{0}_thigh" pos="0 {1} 0"><joint name="{0}_lift"/><geom fromto="0 0 0 .1 0 -.2"/>
<body name="{0}_shank" pos=".1 0 -.2"><joint name="{0}_bend"/><geom fromto="0 0 0 -.1 0 -.2"/>
<site name="{0}_lug" pos=".04 0 0"/>
<body name="{0}_rim" pos="-.1 {2} -.2"><joint name="{0}_roll"/>
<geom name="{0}_tyre" type="sphere" size=".07" contype="1"/></body></body></body>
<body name="{0}_crank" pos="0 {1} 0"><joint name="{0}_pull"/><geom fromto="0 0 0 .04 0 0"/>
<body name="{0}_rod" pos=".04 0 0"><joint name="{0}_hang"/><geom fromto="0 0 0 .1 0 -.2"/>
<site name="{0}_eye" pos=".1 0 -.2"/></body></body>)",
      side, y, 0.4 * y);
}

std::string parallel_robot() {
  std::string motors;
  for (const char* side : {"left", "right"}) {
    for (const auto& [joint, most] : {std::pair("lift", 25), {"pull", 15}, {"roll", 5}}) {
      motors +=
          fmt::format("<motor joint=\"{}_{}\" ctrlrange=\"-{} {}\"/>\n", side, joint, most, most);
    }
  }
  return fmt::format(
      R"(<mujoco model="parallel">
<default><joint axis="0 1 0"/><geom type="capsule" size=".01" contype="0" conaffinity="0"/></default>
<worldbody><body name="trunk" pos="0 0 .5"><freejoint/>
<geom type="box" size=".1 .08 .05" pos="0 0 .05" contype="1"/><site name="imu"/>{}{}
</body></worldbody>
<equality><connect name="left_loop" body1="left_rod" body2="left_shank" anchor=".1 0 -.2"/>
<connect name="right_loop" site1="right_eye" site2="right_lug"/></equality>
<actuator>{}</actuator></mujoco>)",
      parallel_leg("left", 0.1), parallel_leg("right", -0.1), motors);
}

const std::string parallel_keys =
    "mjcf: robot.xml\n"
    "joints: {left_hip: left_lift, left_knee: left_bend, left_wheel: left_roll,\n"
    "         right_hip: right_lift, right_knee: right_bend, right_wheel: right_roll}\n"
    "tyres: {left: left_tyre, right: right_tyre}\n";

class ClosedRobot : public ::testing::Test {
 protected:
  /// The robot after edits of its MJCF; `keys` are more lines of its YAML file.
  RobotModel robot(const std::vector<Edit>& edits, const std::string& keys = {}) {
    folder_.write("robot.xml", edited(parallel_robot(), edits));
    return compile_robot_model(folder_.write("robot.yaml", parallel_keys + keys), Terrain{});
  }

  void expect_refusal(const std::vector<Edit>& edits, const std::string& words,
                      const std::string& keys = {}) {
    const std::string complaint = complaint_of([&] { (void)robot(edits, keys); });
    EXPECT_THAT(complaint, AllOf(HasSubstr(words), Not(HasSubstr("\n")),
                                 ::testing::ContainsRegex("robot[.](xml|yaml):[0-9]+:[0-9]+: ")));
  }

  ScratchFolder folder_;
};

TEST_F(ClosedRobot, HasTheRatesOfAParallelogram) {
  const RobotModel model = robot({});
  for (std::size_t leg = 0; leg < wheel_count; ++leg) {
    ASSERT_TRUE(model.closed_leg[leg]);
    const Linkage& linkage = model.closed_leg[leg]->linkage;
    // The shank turns as the crank does. The crank's joint keeps the sign of the file.
    const double sign = leg == 0 ? -1.0 : 1.0;
    LinkageVector q = linkage.start;
    ASSERT_TRUE(move_linkage(linkage, linkage.motors,
                             std::array{linkage.start[0] + 0.2, linkage.start[2] - 0.3}, q));
    EXPECT_NEAR(q[0] + q[1] - linkage.start[0] - linkage.start[1], -0.3 * sign, 1e-9);
    Eigen::Matrix2d expected;
    expected << 1.0, 0.0, -1.0, sign;
    EXPECT_LT((Eigen::Matrix2d(MotorMap(linkage, q).leg) - expected).norm(), 1e-9);
    EXPECT_EQ(model.effort[3 * leg], 25.0);
    EXPECT_EQ(model.effort[3 * leg + 1], 15.0);
  }
}

TEST_F(ClosedRobot, IsTheSameByLoopsOfItsYamlFile) {
  const RobotModel by_connects = robot({});
  const RobotModel by_keys = robot(
      {{"<equality>[\\s\\S]*</equality>", ""}, {"<motor joint=\"(left|right)_pull\"[^>]*>", ""}},
      "loops:\n"
      "  - {bodies: [left_rod, left_shank], anchor: [.1, 0, -.2]}\n"
      "  - {bodies: [right_rod, right_shank], anchor: [.1, 0, -.2], second_anchor: [.04, 0, 0]}\n"
      "motors: {left: [left_lift, left_pull], right: [right_lift, right_pull]}\n"
      "actuators: {knee: {maximum_torque: 12}}\n");
  EXPECT_EQ(by_keys.effort[1], 12.0);
  for (std::size_t leg = 0; leg < wheel_count; ++leg) {
    const Linkage& first = by_connects.closed_leg[leg]->linkage;
    const Linkage& second = by_keys.closed_leg[leg]->linkage;
    EXPECT_EQ(first.motors, second.motors);
    EXPECT_LT((first.start - second.start).norm(), 1e-9);
    EXPECT_LT((MotorMap(first, first.start).all - MotorMap(second, second.start).all).norm(), 1e-9);
  }
}

TEST_F(ClosedRobot, IsRefusedInOneLine) {
  const std::string loop = "<connect name=\"left_loop\"[^>]*/>";
  const auto of_sites = [](const std::string& first, const std::string& second) {
    return fmt::format("<connect name=\"left_loop\" site1=\"{}\" site2=\"{}\"/>", first, second);
  };
  const auto eye_at = [](const std::string& place) {
    return Edit{"<site name=\"left_eye\" pos=\"[^\"]*\"",
                "<site name=\"left_eye\" pos=\"" + place + "\""};
  };
  expect_refusal({{"<motor joint=\"left_pull\"[^>]*>", ""}},
                 "the loops of the left leg leave 2 of its joints free, but 1 has a motor");
  expect_refusal({{"</actuator>", "<motor joint=\"left_hang\" ctrlrange=\"-1 1\"/>$&"}},
                 "expected one or two motors in the left leg");
  expect_refusal({{loop, of_sites("left_eye", "left_lug")}, eye_at(".1 0 -.5")},
                 "the points of its leg's loops are 300.0 mm apart");
  expect_refusal({{loop, of_sites("left_eye", "left_lug")}, eye_at(".1 .007 -.2")},
                 "its points are 7.0 mm apart along the axles");
  expect_refusal({{"<joint name=\"left_pull\"", "$& axis=\".04 1 0\""}}, "its axis is 2.3° off");
  expect_refusal({{"</equality>",
                   "<connect name=\"both\" body1=\"left_shank\" "
                   "body2=\"right_shank\" anchor=\"0 0 0\"/>$&"}},
                 "connect 'both': expected a loop in one leg");
  expect_refusal({{loop, of_sites("left_eye", "left_lugg")}}, "did you mean 'left_lug'?");
  expect_refusal({{loop, "<connect name=\"left_loop\" body1=\"left_rod\" anchor=\".1 0 -.2\"/>"}},
                 "found the world");
  expect_refusal({{loop,
                   "<connect name=\"left_loop\" body1=\"left_rod\" body2=\"left_rim\" "
                   "anchor=\".1 0 -.2\"/>"}},
                 "expected it on the wheel's axle");
  expect_refusal({{loop, ""}}, "expected it in a loop of one leg");
  expect_refusal({{"<joint name=\"left_hang\"", "$& type=\"slide\""}}, "expected a hinge");
  expect_refusal({{"<joint name=\"left_hang\"", "$& stiffness=\"3\""}}, "expected no spring");
  expect_refusal({{loop, "<weld body1=\"left_rod\" body2=\"left_shank\"/>"}},
                 "a <connect> closes a leg");
}

TEST_F(ClosedRobot, IsRefusedAtTheKeyOfItsYamlFile) {
  // A shank that pulls crank and rod into one line.
  const std::vector<Edit> pulling = {
      {"<connect name=\"left_loop\"[^>]*/>",
       "<connect name=\"left_loop\" site1=\"left_eye\" site2=\"left_lug\"/>"},
      {"<site name=\"left_lug\" pos=\"[^\"]*\"", "<site name=\"left_lug\" pos=\".06 0 0\""}};
  EXPECT_NO_THROW((void)robot(pulling, "stance: {hip: 0, knee: 0.1}\n"));
  expect_refusal(pulling, "the rods of the left leg are in line",
                 "stance: {hip: 0, knee: 0.17004}\n");
  expect_refusal(pulling, "the loops of the left leg do not close",
                 "stance: {hip: 0, knee: 0.3}\n");
  expect_refusal({}, "expected none for a leg with closed loops", "legs: {length: 1.1}\n");
  expect_refusal({}, "expected a body named 'left_bar'",
                 "loops: [{bodies: [left_bar, left_rod], anchor: [0, 0, 0]}]\n");
  expect_refusal({}, "expected a joint named 'left_pul'",
                 "motors: {left: [left_pul], right: [right_pull]}\n");
  expect_refusal({{"<motor joint=\"left_pull\"[^>]*>", ""}}, "its torque limit",
                 "motors: {left: [left_pull], right: [right_pull]}\n");
  expect_refusal({}, "expected three numbers",
                 "loops: [{bodies: [left_rod, left_shank], anchor: [0, 0]}]\n");
}

/// The shipped four-bar robot with edits of its YAML file.
RobotModel four_bar(const ScratchFolder& folder, const Edit& edit) {
  const std::string folder_of_models = TOUCHDOWN_SOURCE_DIR "/models/";
  return compile_robot_model(
      folder.write("four.yaml", edited(read_file(folder_of_models + "four_bar.yaml"),
                                       {{"legs/", folder_of_models + "legs/"}, edit})),
      Terrain{});
}

TEST_F(ClosedRobot, HasAnchorsInMetresThatAreAlikeInBothLegs) {
  const std::string left = "(left_shank\\], anchor: )\\[0.0889219, 0, -0.133015\\]";
  for (const char* anchor : {"[88.9, 0, -133.0]", "[0, 3, 0]", "[-5, 0, -2]"}) {
    EXPECT_THAT(complaint_of([&] {
                  four_bar(folder_, {left, std::string("$1") + anchor});
                }),
                AllOf(HasSubstr("four.yaml:11:49: loops.0.anchor: "), HasSubstr("is it in mm?")));
  }
  for (const auto& [anchor, gap] :
       std::vector<std::pair<const char*, const char*>>{{"[0.1389219, 0, -0.133015]", "50.0"},
                                                        {"[0.0889219, 0, -0.113015]", "20.0"},
                                                        {"[0.0919219, 0, -0.137015]", "5.0"}}) {
    EXPECT_THAT(four_bar(folder_, {left, std::string("$1") + anchor}).warnings,
                ElementsAre(HasSubstr(fmt::format("left leg meets {} mm from where", gap))));
  }
  EXPECT_THAT(four_bar(folder_, {"lqr", "lqr"}).warnings, IsEmpty());
}

}  // namespace
}  // namespace touchdown::models
