#pragma once

#include <string_view>

#include "noise/sensors/profile.hpp"

namespace touchdown::noise {

/// Returns the profile with one disturbance set to `value`, for sensitivity studies. `key` names
/// the disturbance of
/// - all sensors that can have it (`dropout`, `delay`, `scale`, `low_pass`, `rate`),
/// - one sensor (`torque.white`),
/// - or one channel (`torque.knee.white`).
/// `value` sets the rate of a dropout, the amplitude of a vibration, the time constant of a
/// low-pass (s), and the standard deviation of scale, bias and coloured noise. Any other
/// disturbance has one number only. Errors: `InputError` for an unknown key, and for a value out of
/// range.
SensorProfile with_value(SensorProfile profile, std::string_view key, double value);

}  // namespace touchdown::noise
