#include <algorithm>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "models/robot_model.hpp"
#include "tests/models/upkie_mjcf.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::models {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class NamingContract : public ::testing::Test {
 protected:
  std::string write(const std::string& text) {
    const std::filesystem::path path = folder_ / "robot.xml";
    std::ofstream(path) << text;
    return path.string();
  }

  /// Upkie with `what` replaced; the complaint about it.
  std::string complaint(const std::string& what, const std::string& by) {
    const std::string text = read_file(upkie_mjcf);
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return complaint_about(std::string(text).replace(at, what.size(), by));
  }

  std::string complaint_about(const std::string& text) {
    const std::string file = write(text);
    try {
      (void)compile_robot_model(file, Terrain{});
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), StartsWith(file + ":"));
      EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
      return error.what();
    }
    ADD_FAILURE() << "no complaint";
    return "";
  }

  const ScratchFolder scratch_;
  const std::filesystem::path folder_ = scratch_.path();
};

TEST_F(NamingContract, AFileWithoutAnElementIsNoRobot) {
  for (const char* text : {"<!-- nothing -->", "<?xml version=\"1.0\"?>\n", "<!DOCTYPE mujoco>", "",
                           " \n", "</mujoco>", "<!-- </mujoco> -->"}) {
    EXPECT_THAT(complaint_about(text), HasSubstr(":1: expected ")) << text;
  }
}

TEST_F(NamingContract, MissingNamesAreNamed) {
  EXPECT_THAT(complaint("<motor name=\"left_knee\"", "<motor name=\"knee_left\""),
              HasSubstr("motor named 'left_knee'"));
  EXPECT_THAT(complaint("geom name=\"right_tire\"", "geom name=\"right_wheel_rubber\""),
              HasSubstr("geom named 'right_tire'"));
  EXPECT_THAT(complaint("site name=\"imu\"", "site name=\"sensor\""),
              HasSubstr("site named 'imu'"));
  EXPECT_THAT(complaint("<freejoint name=\"root\"/>", ""), HasSubstr("freejoint"));
}

TEST_F(NamingContract, WrongKindsAreNamed) {
  EXPECT_THAT(
      complaint("name=\"left_hip\" joint=\"left_hip\"", "name=\"left_hip\" joint=\"right_hip\""),
      HasSubstr("drive joint 'left_hip'"));
  EXPECT_THAT(complaint("<joint name=\"left_knee\"", "<joint type=\"slide\" name=\"left_knee\""),
              HasSubstr("'left_knee': expected a hinge"));
  EXPECT_THAT(complaint("joint=\"left_hip\" ctrlrange=\"-16 16\"", "joint=\"left_hip\""),
              HasSubstr("ctrlrange"));
}

TEST_F(NamingContract, BrokenFilesAreLocated) {
  EXPECT_THAT(complaint_about("<mujoco>\n<worldbody>\n"), HasSubstr("XML"));
  EXPECT_THAT(complaint_about(""), HasSubstr("XML"));
  EXPECT_THAT(complaint_about("<robot name=\"upkie\"></robot>"), HasSubstr("<mujoco>"));
  EXPECT_THAT(complaint_about("<mujoco/>"), HasSubstr("<mujoco>"));
}

TEST_F(NamingContract, MuJoCosComplaintsPointIntoTheRobotsFile) {
  const std::string text = read_file(upkie_mjcf);
  const std::size_t at = text.find("<joint name=\"left_hip\"");
  const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<long>(at), '\n');
  EXPECT_THAT(complaint("<joint name=\"left_hip\"", "<joint colour=\"red\" name=\"left_hip\""),
              AllOf(HasSubstr("robot.xml:" + std::to_string(line) + ":"), HasSubstr("colour")));
}

TEST_F(NamingContract, MissingFileIsAnInputError) {
  EXPECT_THROW((void)compile_robot_model(folder_ / "nothing.xml", Terrain{}), InputError);
}

TEST_F(NamingContract, AnotherRobotWorksWithItsIncludesAndDefaults) {
  // Degrees, hostile defaults, and the actuators in an included file beside the robot's.
  std::string text = read_file(upkie_mjcf);
  const std::size_t begin = text.find("<actuator>");
  const std::size_t end = text.find("</actuator>") + 11;
  std::ofstream(folder_ / "motors.xml")
      << "<mujocoinclude>" << text.substr(begin, end - begin) << "</mujocoinclude>";
  text.replace(begin, end - begin, "<include file=\"motors.xml\"/>");
  text.replace(text.find("<default>"), 9,
               "<default><geom friction=\"9 9 9\" margin=\"0.1\" condim=\"1\" rgba=\"1 0 0 1\"/>");
  Terrain terrain{.pieces = {Flat{3.0}, StairFlight{}}};
  const RobotModel robot = compile_robot_model(write(text), terrain);
  EXPECT_EQ(robot.effort[0], 16.0);
  const int tread = mj_name2id(robot.mj.get(), mjOBJ_GEOM, "touchdown_terrain_0");
  ASSERT_GE(tread, 0);
  EXPECT_EQ(robot.mj->geom_friction[3 * tread], 1.0);
  EXPECT_EQ(robot.mj->geom_margin[tread], 0.0);
  EXPECT_EQ(robot.mj->geom_condim[tread], 3);
}

}  // namespace
}  // namespace touchdown::models
