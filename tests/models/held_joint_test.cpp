#include <cmath>

#include <gmock/gmock.h>

#include "models/robot_model.hpp"
#include "tests/models/upkie.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::models {
namespace {

using ::testing::SizeIs;

/// Hip rolls of Upkie, and what holds them.
struct Sibling {
  std::string servo;  ///< of the MJCF, with {0} for its side
  std::string keys;   ///< of the YAML file
  double kp, kd, effort;
};

class RobotWithHeldJoints : public ::testing::Test {
 protected:
  RobotModel robot(const std::string& mjcf, const std::string& keys = "") {
    folder_.write("rolling.xml", mjcf);
    return compile_robot_model(folder_.write("rolling.yaml",
                                             "# Upkie with hip rolls.\nmjcf: rolling.xml\n"
                                             "held: [left_roll, right_roll]\n" +
                                                 keys),
                               Terrain{});
  }

  ScratchFolder folder_;
};

TEST_F(RobotWithHeldJoints, HasTheServosOfTheFileOrOfItsKeys) {
  const std::string on = " joint=\"{0}_roll\" name=\"{0}_roll\" ";
  // By hand: 3 m g L, and with it 0.73 m g L √(L/g) of damping, of 5.35922 kg on legs of 0.343 m.
  const double kp = 3.0 * 5.35922 * 9.81 * 0.343;
  const double kd = kp * 0.73 / 3.0 * std::sqrt(0.343 / 9.81);
  for (const Sibling& s : std::vector<Sibling>{
           {"<position" + on + "kp=\"150\" forcerange=\"-40 40\"/>", "", 150.0, 150.0 * kd / kp,
            40.0},
           {"<position" + on + "kp=\"150\" gear=\"2\" forcerange=\"-20 20\"/>", "", 600.0,
            600.0 * kd / kp, 40.0},
           {"<position" + on + "kp=\"150\" gear=\"-2\" forcerange=\"-20 20\"/>", "", 600.0,
            600.0 * kd / kp, 40.0},
           {"<general" + on +
                "gainprm=\"100\" biastype=\"affine\" biasprm=\"0 -100 -5\" forcerange=\"-9 9\"/>",
            "", 100.0, 5.0, 9.0},
           {"<velocity" + on + "kv=\"3\" forcerange=\"-7 7\"/>", "", kp, 3.0, 7.0},
           {"<motor" + on + "ctrlrange=\"-30 30\"/>", "", kp, kd, 30.0},
           {"<motor" + on + "ctrlrange=\"-3 3\" gear=\"10\"/>", "", kp, kd, 30.0},
           {"<motor name=\"{0}_any\" joint=\"{0}_roll\" ctrlrange=\"-30 30\" forcerange=\"-8 8\"/>",
            "", kp, kd, 8.0},
           {"", "held_servo: {maximum_torque: 25}\n", kp, kd, 25.0},
           {"<position" + on + "kp=\"150\"/>", "held_servo: {maximum_torque: 25}\n", 150.0,
            150.0 * kd / kp, 25.0},
           {"<motor" + on + "ctrlrange=\"-30 30\"/>",
            "held_servo: {kp: 80, kd: 2, maximum_torque: 12}\n", 80.0, 2.0, 12.0},
           {"<position" + on + "kp=\"150\" forcerange=\"-40 40\"/>", "held_servo: {kd: 0}\n", 150.0,
            0.0, 40.0}}) {
    const RobotModel rolling = robot(rolling_upkie("", s.servo), s.keys);
    ASSERT_THAT(rolling.held, SizeIs(2));
    for (const HeldJoint& held : rolling.held) {
      EXPECT_NEAR(held.kp, s.kp, 1e-3 * s.kp) << s.servo << s.keys;
      EXPECT_NEAR(held.kd, s.kd, 1e-3 * s.kd) << s.servo << s.keys;
      EXPECT_NEAR(held.effort, s.effort, 1e-9) << s.servo << s.keys;
    }
    EXPECT_EQ(rolling.held[0].name, "left_roll");
  }
}

TEST_F(RobotWithHeldJoints, LeavesTheRestToTheSimulators) {
  const RobotModel rolling =
      robot(rolling_upkie("ref=\"0.1\" damping=\"0.2\" armature=\"0.01\" frictionloss=\"0.3\""));
  for (const HeldJoint& held : rolling.held) {
    EXPECT_EQ(held.reference, 0.1);
    EXPECT_EQ(held.actuator.viscous, 0.2);
    EXPECT_EQ(held.actuator.friction, 0.3);
    EXPECT_EQ(held.actuator.armature, 0.01);
    EXPECT_EQ(rolling.mj->dof_damping[held.dof_address], 0.0);
    EXPECT_EQ(rolling.mj->dof_frictionloss[held.dof_address], 0.0);
    EXPECT_EQ(rolling.mj->dof_armature[held.dof_address], 0.01);
  }
  for (int i = 0; i < rolling.mj->nu; ++i)
    EXPECT_EQ(rolling.mj->actuator_biasprm[mjNBIAS * i + 1], 0.0);
}

TEST_F(RobotWithHeldJoints, MayHaveTheNamesOfServos) {
  // Hip rolls called left_hip and right_hip, above hips of other names.
  std::string mjcf = rolling_upkie();
  mjcf = std::regex_replace(mjcf, std::regex("\"(left|right)_hip\""), "\"$1_pitch\"");
  mjcf = std::regex_replace(mjcf, std::regex("\"(left|right)_roll\""), "\"$1_hip\"");
  folder_.write("rolling.xml", mjcf);
  const RobotModel rolling =
      compile_robot_model(folder_.write("rolling.yaml",
                                        "# Upkie with hip rolls.\nmjcf: rolling.xml\n"
                                        "joints: {left_hip: left_pitch, right_hip: right_pitch}\n"
                                        "held: [left_hip, right_hip]\n"),
                          Terrain{});
  EXPECT_EQ(rolling.held[1].name, "right_hip");
  EXPECT_EQ(rolling.joint_name[0], "left_pitch");
  EXPECT_NE(rolling.joint[0], rolling.held[0].joint);
}

}  // namespace
}  // namespace touchdown::models
