#include <nlohmann/json.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.hpp"
#include "tests/models/edited_upkie.hpp"

namespace touchdown::cli {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

using CheckOfARobot = InFolder;

TEST_F(CheckOfARobot, PrintsWhatItReadAsTextOrJsonAndExitsWithZero) {
  folder_.write("robot.xml", edited_upkie({}));
  EXPECT_THAT(folder_.output_of("check robot.xml"),
              AllOf(HasSubstr("5.33922 kg"), HasSubstr("left_knee"), HasSubstr("-2.51 to 2.51"),
                    HasSubstr("mujoco: finished"), HasSubstr("bullet: finished"),
                    Not(HasSubstr("complaint"))));
  folder_.write("robot.yml", "# mine\nmjcf: robot.xml\nmass: 1.2\n");
  const auto json = nlohmann::json::parse(folder_.output_of("check robot.yml --json"));
  EXPECT_EQ(json["is_usable"], true);
  EXPECT_NEAR(json["mass_kg"].get<double>(), 1.2 * 5.33922, 1e-4);
  EXPECT_EQ(json["joints"].size(), 6U);
  EXPECT_EQ(json["joints"][3]["axis_in_base"], (std::vector<double>{0, 1, 0}));
  EXPECT_EQ(json["stands"].size(), 2U);
}

TEST_F(CheckOfARobot, PrintsItsComplaintAndExitsWithOne) {
  folder_.write("robot.xml", edited_upkie({added("<option density=\"1\"/>")}));
  const Ended ended = folder_.run("check robot.xml");
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.output, AllOf(HasSubstr("complaint: "), HasSubstr("robot.xml:149:1: option")));
}

}  // namespace
}  // namespace touchdown::cli
