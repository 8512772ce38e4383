#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/mjcf/robot_file.hpp"
#include "models/robot_model.hpp"
#include "tests/complaint.hpp"
#include "tests/models/upkie.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::models {
namespace {

using ::testing::HasSubstr;
using ::testing::UnorderedElementsAre;

TEST(RefusedRobot, HasAllItsComplaintsAtOnce) {
  const ScratchFolder folder;
  const auto complaints = [&](const std::vector<Edit>& edits, const std::string& keys) {
    folder.write("robot.xml", edited_upkie(edits));
    const auto file = folder.write("robot.yaml", "mjcf: robot.xml\n" + keys);
    try {
      (void)compile_robot_model(file, Terrain{});
    } catch (const RobotRefusal& refusal) {
      const std::size_t count = refusal.complaints.size();
      EXPECT_EQ(
          refusal.what(),
          fmt::format("{} (the first of {} reasons; `touchdown check` of this robot prints all)",
                      refusal.complaints[0], count));
      return refusal.complaints;
    }
    return std::vector<std::string>{};
  };
  const std::string knee = "<joint name=\"left_knee\"";
  EXPECT_THAT(complaints({{"<body name=\"torso\"", "$& gravcomp=\"1\""},
                          {knee, knee + " actuatorfrcrange=\"0 5\""},
                          added("<tendon><fixed name=\"rope\"/></tendon>"),
                          added("<equality><weld body1=\"torso\"/></equality>")},
                         "imu: gyro\nheld: [arm]\nno_collision: [guard]\n"),
              UnorderedElementsAre(HasSubstr("gravcomp"), HasSubstr("symmetric"),
                                   HasSubstr("'rope'"), HasSubstr("equality weld"),
                                   HasSubstr("'gyro'"), HasSubstr("'arm'"), HasSubstr("'guard'")));
  EXPECT_THAT(complaints({}, "joints: {left_hip: a, right_knee: b}\ntyres: {left: c}\n"),
              UnorderedElementsAre(HasSubstr("'a'"), HasSubstr("'b'"), HasSubstr("'c'")));
}

TEST(RefusedRobot, HasTooManyGeoms) {
  std::string many;
  for (int i = 0; i < 50'000; ++i) many += "<geom class=\"visual\" size=\"0.01\"/>\n";
  const ScratchFolder folder;
  const auto file = folder.write("robot.xml", edited_upkie({{"<site name=\"imu\"", many + "$&"}}));
  EXPECT_THAT(complaint_of([&] { (void)compile_robot_model(file, Terrain{}); }),
              HasSubstr("expected at most 5000 geoms"));
}

}  // namespace
}  // namespace touchdown::models
