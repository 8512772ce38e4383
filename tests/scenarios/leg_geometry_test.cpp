#include "scenarios/leg_geometry.hpp"

#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "core/resources.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::scenarios {
namespace {

LegGeometry of_robot(const std::string& file) {
  return leg_geometry(models::compile_robot_model(find_resource(file), {}));
}

TEST(LegGeometry, OfUpkieIsTheEstimatorsDefaultToTheBit) {
  for (const char* file : {"models/upkie.xml", "models/upkie_actuated.yaml",
                           "models/upkie_straight.yaml", "models/upkie_large_wheels.yaml"}) {
    EXPECT_EQ(of_robot(file), LegGeometry{}) << file;
  }
}

TEST(LegGeometry, OfLongerLegsAndOfMoreMassIsWhatTheirFilesSay) {
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
  EXPECT_EQ(heavy.lower_length, upkie.lower_length);
}

/// A leg whose links are rods of known mass, written by hand: the thigh .3 m long with its mass in
/// the middle and a brace that is welded to it, the shank .4 m with its mass at three quarters.
/// Hips stand aside of knees, which bending does not feel.
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
                               .lower_centre = 0.75}));
}

}  // namespace
}  // namespace touchdown::scenarios
