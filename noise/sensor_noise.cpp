#include "noise/sensor_noise.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include <fmt/format.h>

#include "core/fields.hpp"
#include "noise/sensor_chain.hpp"

namespace touchdown::noise {

namespace {

/// Levels must increase strictly, so that they form a grid.
KeyNotes describe_levels(Fields& fields, std::string_view key, std::vector<double>& levels) {
  const KeyNotes notes = fields(key, levels);
  fields.check(!levels.empty(), key, "expected at least one number");
  for (std::size_t i = 0; i < levels.size(); ++i) {
    fields.check(levels[i] >= 0.0 && levels[i] <= 1e3, key, "expected numbers from 0 to 1000");
    fields.check(i == 0 || levels[i] > levels[i - 1], key, "expected increasing numbers");
  }
  return notes.range("0 to 1000, increasing");
}

KeyNotes describe_level_on(Fields& fields, std::string_view key, double& level,
                           const std::vector<double>& levels) {
  const KeyNotes notes = fields.require(key, level);
  fields.check(std::find(levels.begin(), levels.end(), level) != levels.end(), key,
               fmt::format("expected one of noise.{}: {}", key, fmt::join(levels, ", ")));
  return notes.range(fmt::format("one of noise.{}", key));
}

}  // namespace

void describe(Fields& fields, NoiseGridConfig& noise) {
  describe_levels(fields, "torque", noise.torque)
      .doc("N·m", "Standard deviations of the noise on knee and wheel torques.");
  describe_levels(fields, "accelerometer", noise.accelerometer)
      .doc("m/s²", "Standard deviations of the noise on each acceleration.");
  KneeWheelGridConfig& knee_wheel = noise.knee_wheel;
  if (fields.present("knee_wheel", !knee_wheel.knee.empty())) {
    fields
        .within(
            "knee_wheel",
            [&](Fields& grid) {
              grid.require("knee");
              grid.require("wheel");
              describe_levels(grid, "knee", knee_wheel.knee).doc("N·m", "Levels of the knees.");
              describe_levels(grid, "wheel", knee_wheel.wheel).doc("N·m", "Levels of the wheels.");
              grid("accelerometer", knee_wheel.accelerometer, 0.0, 1e3)
                  .doc("m/s²", "Noise on each acceleration in this grid.");
            })
        .fallback("none")
        .doc("A second grid with separate levels for knees and wheels.");
  }
  fields.if_set(noise.hips, "hips", noise.hips)
      .doc("Whether the hips have the torque noise of the knees.");
  fields("joint_position", noise.joint_position, 0.0, 1e3)
      .doc("rad", "Noise on every joint position, in every cell.");
  fields("joint_velocity", noise.joint_velocity, 0.0, 1e3)
      .doc("rad/s", "Noise on every joint velocity, in every cell.");
  fields("seeds", noise.seeds, 1, 100'000).doc("Number of noise draws per cell.");
}

void describe(Fields& fields, NoiseCell& cell) {
  fields.require("torque", cell.torque, 0.0, 1e3).doc("N·m", "Noise on knee and wheel torques.");
  fields.require("accelerometer", cell.accelerometer, 0.0, 1e3)
      .doc("m/s²", "Noise on each acceleration.");
  cell.knee = cell.wheel = cell.torque;
}

void describe(Fields& fields, NoiseCell& cell, const NoiseGridConfig& noise) {
  describe_level_on(fields, "torque", cell.torque, noise.torque)
      .doc("N·m", "Noise on knee and wheel torques.");
  describe_level_on(fields, "accelerometer", cell.accelerometer, noise.accelerometer)
      .doc("m/s²", "Noise on each acceleration.");
  cell = as_on_grid({cell.torque, cell.accelerometer}, noise);
}

std::size_t cell_index(const std::vector<NoiseCell>& cells, const NoiseCell& wanted) {
  return static_cast<std::size_t>(std::find(cells.begin(), cells.end(), wanted) - cells.begin());
}

NoiseCell knee_wheel_cell(double knee, double wheel, double accelerometer) {
  const double alike = knee == wheel ? knee : std::numeric_limits<double>::quiet_NaN();
  return {alike, accelerometer, knee, wheel};
}

NoiseCell as_on_grid(NoiseCell cell, const NoiseGridConfig& noise) {
  cell.hip = noise.hips ? cell.knee : 0.0;
  cell.joint_position = noise.joint_position;
  cell.joint_velocity = noise.joint_velocity;
  return cell;
}

std::vector<NoiseCell> noise_cells(const NoiseGridConfig& noise) {
  std::vector<NoiseCell> cells;
  for (const double torque : noise.torque) {
    for (const double accelerometer : noise.accelerometer) cells.push_back({torque, accelerometer});
  }
  const KneeWheelGridConfig& grid = noise.knee_wheel;
  for (const double knee : grid.knee) {
    for (const double wheel : grid.wheel) {
      const NoiseCell cell = knee_wheel_cell(knee, wheel, grid.accelerometer);
      if (std::find(cells.begin(), cells.end(), cell) == cells.end()) cells.push_back(cell);
    }
  }
  for (NoiseCell& cell : cells) cell = as_on_grid(cell, noise);
  return cells;
}

models::Observation with_noise(const models::Observation& observation, const NoiseKey& key,
                               std::uint64_t step, const SensorNoise& levels) {
  models::Observation noisy = observation;
  const auto add = [&](double& value, double sigma, NoiseChannel channel) {
    if (sigma > 0.0) value += sigma * standard_normal(key, channel, step);
  };
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    add(acceleration[static_cast<int>(axis)], levels.acceleration,
        axis_channel(NoiseChannel::accelerometer_x, axis));
  }
  noisy.imu.linear_acceleration += acceleration;
  noisy.imu.raw_linear_acceleration += acceleration;
  const std::array torque = {levels.hip_torque, levels.knee_torque, levels.wheel_torque};
  for (std::size_t i = 0; i < models::servo_count; ++i) {
    const auto servo = static_cast<models::Servo>(i);
    add(noisy.servo[i].torque, torque[i % torque.size()], torque_channel(servo));
    add(noisy.servo[i].position, levels.joint_position, position_channel(servo));
    add(noisy.servo[i].velocity, levels.joint_velocity, velocity_channel(servo));
  }
  return noisy;
}

}  // namespace touchdown::noise
