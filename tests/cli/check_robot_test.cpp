#include <nlohmann/json.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.hpp"
#include "tests/models/upkie.hpp"

namespace touchdown::cli {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(CheckOfARobot, PrintsWhatItReadAndExitsWithZero) {
  const ScratchFolder folder;
  folder.write("robot.xml", edited_upkie({}));
  const Ended ended = touchdown_program("check robot.xml", folder.path());
  EXPECT_EQ(ended.exit_code, 0) << ended.errors;
  EXPECT_THAT(ended.output, AllOf(HasSubstr("5.33922 kg"), HasSubstr("left_knee"),
                                  HasSubstr("-2.51 to 2.51"), HasSubstr("mujoco: finished"),
                                  HasSubstr("bullet: finished"), Not(HasSubstr("complaint"))));
}

TEST(CheckOfARobot, PrintsItsComplaintAndExitsWithOne) {
  const ScratchFolder folder;
  folder.write("robot.xml", edited_upkie({added("<option density=\"1\"/>")}));
  const Ended ended = touchdown_program("check robot.xml", folder.path());
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.output, AllOf(HasSubstr("complaint: "), HasSubstr("robot.xml:149:1: option")));
}

TEST(CheckOfARobot, PrintsJson) {
  const ScratchFolder folder;
  folder.write("robot.xml", edited_upkie({}));
  folder.write("robot.yml", "# mine\nmjcf: robot.xml\nmass: 1.2\n");
  const auto json =
      nlohmann::json::parse(touchdown_program("check robot.yml --json", folder.path()).output);
  EXPECT_EQ(json["is_usable"], true);
  EXPECT_NEAR(json["mass_kg"].get<double>(), 1.2 * 5.33922, 1e-4);
  EXPECT_EQ(json["joints"].size(), 6U);
  EXPECT_EQ(json["joints"][3]["axis_in_base"], (std::vector<double>{0, 1, 0}));
  EXPECT_EQ(json["stands"].size(), 2U);
}

}  // namespace
}  // namespace touchdown::cli
