#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/robot_model.hpp"
#include "tests/complaint.hpp"
#include "tests/models/upkie.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::models {
namespace {

using ::testing::HasSubstr;

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
