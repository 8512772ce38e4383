#pragma once

#include <string_view>

#include "noise/sensors/profile.hpp"

namespace touchdown::noise {

/// The profile with one of its numbers at `value`, as a study varies it. `key` names a disturbance
/// of every sensor that can have it (`dropout`, `delay`, `scale`, `low_pass`, `rate`), of one
/// sensor (`torque.white`) or of one channel (`torque.knee.white`). It stands for the one number
/// that says how much of it there is: the rate of a dropout, the amplitude of a vibration, the time
/// constant of a low-pass (s), of all else the standard deviation. Errors: `InputError` for what
/// there is not, and for a value out of range.
SensorProfile with_value(SensorProfile profile, std::string_view key, double value);

}  // namespace touchdown::noise
