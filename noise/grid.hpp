#pragma once

#include <vector>

#include "noise/sensor_noise.hpp"

namespace touchdown {
class Fields;
}

namespace touchdown::noise {

/// Noise on knees and wheels apart, at one level of accelerometer noise; empty lists for none.
struct KneeWheelGridConfig {
  std::vector<double> knee = {};   ///< N·m
  std::vector<double> wheel = {};  ///< N·m
  double accelerometer = 0.0;      ///< on each axis (m/s²)
};

/// Standard deviations of Gaussian noise on what the estimator hears, as lists to be combined, and
/// how often each combination is drawn anew.
struct NoiseGridConfig {
  std::vector<double> torque = {0.0};         ///< on knees and wheels alike (N·m)
  std::vector<double> accelerometer = {0.0};  ///< on each axis (m/s²)
  KneeWheelGridConfig knee_wheel = {};        ///< a second grid
  bool hips = false;                          ///< whether hips have the knees' torque noise
  double joint_position = 0.0;                ///< on every encoder, in every cell (rad)
  double joint_velocity = 0.0;                ///< on every encoder, in every cell (rad/s)
  int seeds = 1;
};

/// One noise setting of a sweep: torque noise on knees and wheels alike, or apart.
struct NoiseCell {
  double torque = 0.0;          ///< on knees and wheels (N·m); NaN where they differ
  double accelerometer = 0.0;   ///< on each axis (m/s²)
  double knee = torque;         ///< N·m
  double wheel = torque;        ///< N·m
  double hip = 0.0;             ///< N·m: nothing or as the knees
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
/// Torque noise on knees and wheels alike, and accelerometer noise.
void describe(Fields& fields, NoiseCell& cell);
/// A cell that the grid must have.
void describe(Fields& fields, NoiseCell& cell, const NoiseGridConfig& noise);

/// Where a cell stands among others that have it.
std::size_t cell_index(const std::vector<NoiseCell>& cells, const NoiseCell& wanted);

/// A cell of a knee × wheel grid.
NoiseCell knee_wheel_cell(double knee, double wheel, double accelerometer);

/// The cell with the noise of hips and encoders that belongs to every cell of the grid.
NoiseCell as_on_grid(NoiseCell cell, const NoiseGridConfig& noise);

/// Every combination of the grid's noise levels: torque by torque, accelerometer within; then knee
/// by knee, wheel within, without those that were there already.
std::vector<NoiseCell> noise_cells(const NoiseGridConfig& noise);

}  // namespace touchdown::noise
