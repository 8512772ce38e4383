#pragma once

#include "core/tables/columns.hpp"
#include "noise/sensor_noise.hpp"

namespace touchdown::experiments {

/// The columns of a noise setting: `torque_noise_nm`, `accelerometer_noise_mps2`.
Columns<noise::NoiseCell> noise_columns();

/// The separate levels of a setting, for tables of the knee × wheel grid: `knee_noise_nm`,
/// `wheel_noise_nm`.
Columns<noise::NoiseCell> knee_wheel_columns();

}  // namespace touchdown::experiments
