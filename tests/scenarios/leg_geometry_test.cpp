#include "scenarios/leg_geometry.hpp"

#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "core/resources.hpp"
#include "tests/scratch_folder.hpp"
#include "tests/simulators/upkie.hpp"

namespace touchdown::scenarios {
namespace {

LegGeometry of_robot(const std::string& file) {
  return leg_geometry(models::compile_robot_model(find_resource(file), {}));
}

TEST(LegGeometry, OfUpkieIsTheEstimatorsDefaultToTheBit) {
  for (const char* file : {"models/upkie.xml", "models/upkie_straight.yaml"}) {
    EXPECT_EQ(of_robot(file), LegGeometry{}) << file;
  }
  LegGeometry actuated;  // friction and rotors of its actuators are its own
  actuated.hip_friction = actuated.knee_friction = 0.06;
  actuated.hip_armature = actuated.knee_armature = 0.003;
  EXPECT_EQ(of_robot("models/upkie_actuated.yaml"), actuated);
  LegGeometry large = of_robot("models/upkie_large_wheels.yaml");
  EXPECT_GT(large.wheel_inertia, 2.0 * LegGeometry{}.wheel_inertia);
  large.wheel_inertia = LegGeometry{}.wheel_inertia;
  EXPECT_EQ(large, LegGeometry{}) << "all but the wheels' inertia";
}

/// By MuJoCo's inverse dynamics: the torque that accelerates the left wheel alone by 1 rad/s²,
/// without gravity and with its centre of mass on its axle.
double inertia_by_inverse_dynamics(const models::RobotModel& robot) {
  robot.mj->opt.disableflags |= mjDSBL_GRAVITY | mjDSBL_CONTACT;
  const int body = robot.mj->geom_bodyid[robot.tyre_geom[0]];
  robot.mj->body_ipos[3 * body] = robot.mj->body_ipos[3 * body + 2] = 0.0;
  const models::MjDataPtr data = models::at_zero(robot);
  const int wheel = robot.dof_address[models::index(models::Servo::left_wheel)];
  data->qacc[wheel] = 1.0;
  mj_inverse(robot.mj.get(), data.get());
  return data->qfrc_inverse[wheel];
}

TEST(LegGeometry, HasTheInertiaOfTheWheelInTheModel) {
  const ScratchFolder folder;
  const auto with_rotors = folder.write(
      "rotors.yaml",
      fmt::format("mjcf: {}\nactuators: {{wheel: {{armature: 0.0002}}}}\n",
                  std::filesystem::absolute(find_resource("models/upkie.xml")).string()));
  const auto of = [](const std::filesystem::path& file) {
    const models::RobotModel robot = models::compile_robot_model(file, {});
    const double found = leg_geometry(robot).wheel_inertia;
    EXPECT_NEAR(found, inertia_by_inverse_dynamics(robot), 0.5e-8) << file;
    return found;
  };
  const double upkie = of(find_resource("models/upkie.xml"));
  EXPECT_NEAR(of(find_resource("models/upkie_heavy.yaml")), 1.5 * upkie, 1e-8);
  EXPECT_NEAR(of(find_resource("models/upkie_long_legs.yaml")), upkie, 1e-8);
  EXPECT_GT(of(find_resource("models/upkie_large_wheels.yaml")), 2.0 * upkie);
  EXPECT_NEAR(of(with_rotors), upkie + 2e-4, 1e-8);
}

TEST(LegGeometry, OfLongerAndHeavierLegsFollowsTheirFiles) {
  const LegGeometry upkie;
  const LegGeometry longer = of_robot("models/upkie_long_legs.yaml");
  EXPECT_NEAR(longer.upper_length, 1.4 * upkie.upper_length, 1e-6);
  EXPECT_NEAR(longer.lower_length, 1.4 * upkie.lower_length, 1e-6);
  EXPECT_EQ(longer.upper_mass, upkie.upper_mass);
  EXPECT_EQ(longer.upper_centre, upkie.upper_centre);
  const LegGeometry heavy = of_robot("models/upkie_heavy.yaml");
  EXPECT_NEAR(heavy.upper_mass, 1.5 * upkie.upper_mass, 1e-6);
  EXPECT_NEAR(heavy.lower_mass, 1.5 * upkie.lower_mass, 1e-6);
  EXPECT_NEAR(heavy.wheel_mass, 1.5 * upkie.wheel_mass, 1e-6);
  EXPECT_NEAR(heavy.robot_mass, 1.5 * upkie.robot_mass, 1e-6);
  EXPECT_EQ(heavy.lower_length, upkie.lower_length);
}

/// A leg made of rods of known mass. The thigh is .3 m long, with its mass in the middle and a
/// brace welded to it; the shank is .4 m long, with its mass at three quarters. Hips and knees have
/// lateral offsets, which do not change how the leg bends.
TEST(LegGeometry, IsMeasuredInThePlaneInWhichTheLegBends) {
  const auto leg = [](const std::string& side, double y) {
    const std::string s = side == "left" ? "" : "-";
    const auto body = [&](const std::string& pos, const std::string& joint, const std::string& kg,
                          const std::string& centre, const std::string& inner) {
      return "<body pos='" + pos + "'><joint name='" + side + "_" + joint +
             "' type='hinge' axis='0 1 0'/><inertial pos='" + centre + "' mass='" + kg +
             "' diaginertia='.001 .001 .001'/>" + inner + "</body>";
    };
    const std::string wheel =
        body("0 " + s + ".02 -.4", "wheel", ".2", "0 0 0",
             "<geom name='" + side + "_tire' type='cylinder' size='.06 .02' euler='90 0 0'/>");
    const std::string shank = body("0 " + s + ".03 -.3", "knee", ".5", "0 0 -.3", wheel);
    const std::string brace =
        "<body pos='0 0 -.15'><inertial pos='0 0 0' mass='.4' diaginertia='.001 .001 "
        ".001'/></body>";
    return body("0 " + std::to_string(y) + " 0", "hip", ".6", "0 .01 -.15", brace + shank);
  };
  std::string motors;
  for (const char* side : {"left", "right"}) {
    for (const char* joint : {"hip", "knee", "wheel"}) {
      motors += fmt::format(
          "<motor name='{0}_{1}' joint='{0}_{1}' ctrllimited='true' ctrlrange='-16 16'/>", side,
          joint);
    }
  }
  const ScratchFolder folder;
  folder.write("rods.xml",
               "<mujoco model='rods'><worldbody><body name='base' pos='0 0 1'><freejoint/>"
               "<inertial pos='0 0 0' mass='3' diaginertia='.1 .1 .1'/><site name='imu'/>" +
                   leg("left", 0.1) + leg("right", -0.1) + "</body></worldbody><actuator>" +
                   motors + "</actuator></mujoco>");
  const LegGeometry rods = leg_geometry(models::compile_robot_model(folder / "rods.xml", {}));
  EXPECT_EQ(rods, (LegGeometry{.upper_length = 0.3,
                               .lower_length = 0.4,
                               .upper_mass = 1.0,
                               .lower_mass = 0.5,
                               .wheel_mass = 0.2,
                               .upper_centre = 0.5,
                               .lower_centre = 0.75,
                               .wheel_inertia = 0.001,
                               .robot_mass = 6.4,
                               .upper_inertia = 0.002,
                               .lower_inertia = 0.001,
                               .wheel_torque_limit = 16.0,
                               .hip_upward = 0.0,
                               // Half of (.6·.2 + .4·.2 + .5·.26 + .2·.3) kg·m over 1.7 kg: the
                               // thighs' lateral offsets are not mirrored.
                               .leg_sideways = 0.114706}));
}

}  // namespace
}  // namespace touchdown::scenarios
