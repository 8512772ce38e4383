#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "models/robot.hpp"
#include "noise/gaussian.hpp"

namespace touchdown {
class Fields;
}

namespace touchdown::noise {

/// Standard deviations of the sensors' white Gaussian noise. Zero means no noise.
struct SensorNoise {
  double knee_torque = 0.0;     ///< N·m, each knee
  double wheel_torque = 0.0;    ///< N·m, each wheel
  double acceleration = 0.0;    ///< m/s², each axis of the accelerometer
  double joint_position = 0.0;  ///< rad, each servo's encoder
  double joint_velocity = 0.0;  ///< rad/s, each servo's encoder
  double hip_torque = 0.0;      ///< N·m, each hip

  bool operator==(const SensorNoise&) const = default;
};

/// Adds noise to the observation at `step` of a run. The accelerometer's noise is in the IMU frame
/// and the same with and without gravity. Attitude and gyroscope stay exact.
models::Observation with_noise(const models::Observation& observation, const NoiseKey& key,
                               std::uint64_t step, const SensorNoise& levels);

/// A grid of separate noise levels for knees and wheels, at one level of accelerometer noise. Empty
/// lists mean no such grid.
struct KneeWheelGridConfig {
  std::vector<double> knee = {};   ///< N·m
  std::vector<double> wheel = {};  ///< N·m
  double accelerometer = 0.0;      ///< on each axis (m/s²)
};

/// Standard deviations of the Gaussian noise on the estimator's inputs. The lists are combined to a
/// grid; each combination is drawn `seeds` times.
struct NoiseGridConfig {
  std::vector<double> torque = {0.0};         ///< the same on knees and wheels (N·m)
  std::vector<double> accelerometer = {0.0};  ///< on each axis (m/s²)
  KneeWheelGridConfig knee_wheel = {};        ///< a second grid, with separate levels
  bool hips = false;                          ///< whether hips have the knees' torque noise
  double joint_position = 0.0;                ///< on every encoder, in every cell (rad)
  double joint_velocity = 0.0;                ///< on every encoder, in every cell (rad/s)
  int seeds = 1;
};

/// One cell of the grid: the same torque noise on knees and wheels, or separate levels.
struct NoiseCell {
  double torque = 0.0;          ///< on knees and wheels (N·m); NaN where they differ
  double accelerometer = 0.0;   ///< on each axis (m/s²)
  double knee = torque;         ///< N·m
  double wheel = torque;        ///< N·m
  double hip = 0.0;             ///< N·m: zero or as the knees
  double joint_position = 0.0;  ///< rad; the same in every cell of an experiment
  double joint_velocity = 0.0;  ///< rad/s; likewise

  SensorNoise levels() const {
    return {.knee_torque = knee,
            .wheel_torque = wheel,
            .acceleration = accelerometer,
            .joint_position = joint_position,
            .joint_velocity = joint_velocity,
            .hip_torque = hip};
  }

  friend bool operator==(const NoiseCell& a, const NoiseCell& b) {
    return a.knee == b.knee && a.wheel == b.wheel && a.accelerometer == b.accelerometer;
  }
};

void describe(Fields& fields, NoiseGridConfig& noise);
/// A cell with the same torque noise on knees and wheels.
void describe(Fields& fields, NoiseCell& cell);
/// A cell that must be part of the grid.
void describe(Fields& fields, NoiseCell& cell, const NoiseGridConfig& noise);

/// Index of a cell in `cells`; their number if it is not among them.
std::size_t cell_index(const std::vector<NoiseCell>& cells, const NoiseCell& wanted);

/// A cell of a knee × wheel grid.
NoiseCell knee_wheel_cell(double knee, double wheel, double accelerometer);

/// Adds the noise of hips and encoders, which is the same in every cell of the grid.
NoiseCell as_on_grid(NoiseCell cell, const NoiseGridConfig& noise);

/// All cells of the grid: torque in the outer loop, accelerometer in the inner loop. Then the knee
/// × wheel grid, knee in the outer loop, without duplicates.
std::vector<NoiseCell> noise_cells(const NoiseGridConfig& noise);

}  // namespace touchdown::noise
