#include <algorithm>
#include <cmath>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "render/studies/registry.hpp"
#include "tests/complaint.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::render {
namespace {

using ::testing::HasSubstr;

/// 1.5 s at 1 kHz; both wheels leave the ground at `takeoff` for 200 ms and fall freely.
logs::Recording dropped(const std::string& simulator, std::size_t takeoff) {
  logs::Recording recording;
  recording.info.simulator = simulator;
  for (std::size_t k = 0; k < 1500; ++k) {
    const bool flies = k >= takeoff && k < takeoff + 200;
    const double fallen =
        1e-3 * static_cast<double>(std::min<std::size_t>(k > takeoff ? k - takeoff : 0, 200));
    models::Observation observation;
    observation.servo[models::index(models::Servo::left_knee)].torque = flies ? 0.1 : 1.5;
    observation.servo[models::index(models::Servo::left_wheel)].torque = flies ? 0.02 : 0.4;
    recording.observation.push_back(observation);
    recording.action.emplace_back();
    models::GroundTruth truth;
    truth.base_position = {0.0, 0.0, 2.0 - 0.5 * 9.81 * fallen * fallen};
    truth.wheel_normal_force = {flies ? 0.0 : 26.0, flies ? 0.0 : 26.0};
    recording.truth.push_back(truth);
  }
  return recording;
}

std::vector<std::vector<double>> numbers_of(const std::filesystem::path& path) {
  std::vector<std::vector<double>> rows;
  std::istringstream lines(read_file(path));
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line.front() == '#') continue;
    std::istringstream cells(line);
    rows.emplace_back();
    for (double value = 0.0; cells >> value;) rows.back().push_back(value);
  }
  return rows;
}

TEST(DropOverlay, AlignsBothEnginesAtTheirTakeoffs) {
  const ScratchFolder folder;
  DropOverlay what;
  what.title = "one drop";
  const Figure figure =
      draw_drop_overlay(dropped("mujoco", 400), dropped("bullet", 650), what, folder / "overlay");
  EXPECT_TRUE(std::filesystem::exists(figure.png));
  for (const char* engine : {"mujoco", "bullet"}) {
    const auto rows = numbers_of(folder / (std::string("overlay_") + engine + ".dat"));
    ASSERT_EQ(rows.size(), 600U) << engine;  // 150 ms before takeoff, 450 ms after it
    for (const auto& row : rows) {
      ASSERT_EQ(row.size(), 6U);
      const double time = 1e-3 * row[0];
      const double fallen = std::clamp(time, 0.0, 0.2);
      EXPECT_NEAR(row[1], -0.5 * 9.81 * fallen * fallen, 1e-12);
      const bool flies = row[0] > -0.5 && row[0] < 199.5;
      EXPECT_DOUBLE_EQ(row[2], flies ? 0.0 : 26.0);
      EXPECT_DOUBLE_EQ(row[3], flies ? 0.1 : 1.5);
      EXPECT_DOUBLE_EQ(row[4], flies ? 0.02 : 0.4);
    }
  }
}

TEST(DropOverlay, ReportsTheNumberOfDrops) {
  const ScratchFolder folder;
  DropOverlay what;
  what.drop = 1;
  EXPECT_THAT(complaint_of([&] {
                draw_drop_overlay(dropped("mujoco", 400), dropped("bullet", 400), what,
                                  folder / "overlay");
              }),
              HasSubstr("the run in mujoco has 1 drops, counted from 0; none is number 1"));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace touchdown::render
