#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "estimator/force/linkage.hpp"
#include "models/robot_model.hpp"
#include "tests/complaint.hpp"
#include "tests/models/parallel_robot.hpp"
#include "tests/models/upkie.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::models {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

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

/// The shipped four-bar robot with edits of its YAML file.
RobotModel four_bar(const ScratchFolder& folder, const Edit& edit) {
  const std::string folder_of_models = TOUCHDOWN_SOURCE_DIR "/models/";
  return compile_robot_model(
      folder.write("four.yaml", edited(read_file(folder_of_models + "four_bar.yaml"),
                                       {{"legs/", folder_of_models + "legs/"}, edit})),
      Terrain{});
}

TEST_F(ClosedRobot, HasTheMotorsOfEachLegInItsLoops) {
  for (const char* motor : {"right_hip", "left_axle", "right_rocker_pivot"}) {
    EXPECT_THAT(complaint_of([&] {
                  four_bar(folder_, {"(left: \\[)left_hip", fmt::format("$1{}", motor)});
                }),
                AllOf(HasSubstr("four.yaml:"),
                      HasSubstr("motors.left: expected a joint of the left "
                                "leg's loops, found"),
                      HasSubstr(motor)));
  }
}

TEST_F(ClosedRobot, HasAnchorsThatAreAlikeInBothLegs) {
  const std::string left = "(left_shank\\], anchor: )\\[0.0889219, 0, -0.133015\\]";
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
