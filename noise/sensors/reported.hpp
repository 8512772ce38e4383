#pragma once

#include <vector>

#include "models/robot.hpp"
#include "noise/gaussian.hpp"
#include "noise/sensors/profile.hpp"

namespace touchdown::noise {

/// Turns what ideal sensors said at every step of a run into what sensors of this profile report.
/// Acceleration without gravity is what the accelerometer reports, minus gravity along the reported
/// orientation. At a step whose record is missing nothing is a number, not even the time. Pitch and
/// yaw, their rates and the clock stay as they are.
void report_through(const SensorProfile& profile, const NoiseKey& key, double period,
                    std::vector<models::Observation>& observations);

}  // namespace touchdown::noise
