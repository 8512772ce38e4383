#pragma once

#include <cstddef>

namespace touchdown::noise {

/// What may happen to signals between the sensors and an estimator besides white noise.
struct Disturbance {
  double torque_bias = 0.0;  ///< N·m on every knee, a quarter of it on every wheel
  double torque_gain = 1.0;
  bool heavy_tails = false;   ///< the noise of a tenth of the samples is four times as large
  std::size_t imu_delay = 0;  ///< steps, of accelerometer and gyroscope
};

}  // namespace touchdown::noise
