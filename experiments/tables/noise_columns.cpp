#include "experiments/tables/noise_columns.hpp"

namespace touchdown::experiments {

Columns<noise::NoiseCell> noise_columns() {
  return Columns<noise::NoiseCell>()
      .level("torque_noise_nm", &noise::NoiseCell::torque)
      .level("accelerometer_noise_mps2", &noise::NoiseCell::accelerometer);
}

Columns<noise::NoiseCell> knee_wheel_columns() {
  return Columns<noise::NoiseCell>()
      .level("knee_noise_nm", &noise::NoiseCell::knee)
      .level("wheel_noise_nm", &noise::NoiseCell::wheel);
}

}  // namespace touchdown::experiments
