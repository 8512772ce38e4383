#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "core/table.hpp"
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

TEST(DropOverlay, AlignsBothEnginesAtTheirTakeoffs) {
  const ScratchFolder folder;
  DropOverlay what;
  what.title = "one drop";
  const Figure figure =
      draw_drop_overlay(dropped("mujoco", 400), dropped("bullet", 650), what, folder / "overlay");
  EXPECT_TRUE(std::filesystem::exists(figure.png));
  const Table table = table_of(from_csv(read_file(folder / "overlay.dat")));
  EXPECT_EQ(table.rows.size(), 2 * 600U);  // 150 ms before takeoff, 450 ms after it
  for (const TableRow& row : table.all()) {
    const double time = row.number("time_ms");
    const double fallen = std::clamp(1e-3 * time, 0.0, 0.2);
    EXPECT_NEAR(row.number("height_m"), -0.5 * 9.81 * fallen * fallen, 1e-12);
    const bool flies = time > -0.5 && time < 199.5;
    EXPECT_EQ(row.number("force_n"), flies ? 0.0 : 26.0) << row.text("simulator") << time;
    EXPECT_EQ(row.number("knee_torque_nm"), flies ? 0.1 : 1.5);
    EXPECT_EQ(row.number("wheel_torque_nm"), flies ? 0.02 : 0.4);
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
