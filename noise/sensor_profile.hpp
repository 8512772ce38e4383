#pragma once

#include <array>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>

#include "core/yaml.hpp"

namespace touchdown {
class Fields;
}

namespace touchdown::noise {

/// A constant of a run: `value` plus a draw from N(0, sd).
struct Constant {
  double value = 0.0;
  double sd = 0.0;

  bool operator==(const Constant&) const = default;
};

/// A sine at `order` times the turning frequency of each wheel. The phase is drawn once per run.
struct Vibration {
  double amplitude = 0.0;  ///< the channel's unit per rad/s of the wheel's speed
  double order = 1.0;

  bool operator==(const Vibration&) const = default;
};

/// The mount of an IMU as a mass on a spring and a damper, which rings after impacts.
struct Mount {
  double frequency = 0.0;  ///< Hz; 0: rigid
  double damping = 0.05;   ///< share of the critical damping

  bool operator==(const Mount&) const = default;
};

/// A first-order Gauss-Markov process.
struct ColouredNoise {
  double sd = 0.0;
  double time_constant = 1.0;  ///< s

  bool operator==(const ColouredNoise&) const = default;
};

/// Output of a sensor during a dropout.
enum class DropoutKind : int {
  missing,  ///< the step has no record: estimators are not updated
  frozen,   ///< the last value is repeated
  nan       ///< not a number
};

struct Dropout {
  DropoutKind kind = DropoutKind::frozen;
  double rate = 0.0;     ///< probability per step that a dropout begins
  double length = 0.01;  ///< mean of its geometric distribution (s)

  bool operator==(const Dropout&) const = default;
};

/// Error model between a physical quantity and its reported value, in the order of application
/// (equations: docs/explanation/sensors.md). The defaults change nothing.
struct SensorChannel {
  Constant scale = {};  ///< relative error
  Constant bias = {};   ///< the channel's unit
  double walk = 0.0;    ///< random walk of the bias: its standard deviation after one second
  Vibration vibration = {};
  Mount mount = {};
  ColouredNoise coloured = {};
  double low_pass = 0.0;  ///< time constant (s); 0: none
  double white = 0.0;     ///< standard deviation of the white noise
  /// Of the white noise's Student t distribution, above 2; infinite: a normal distribution.
  double degrees_of_freedom = std::numeric_limits<double>::infinity();
  double range = std::numeric_limits<double>::infinity();  ///< values are clipped to ± this
  double resolution = 0.0;                                 ///< step of the values; 0: none
  double rate = 0.0;   ///< sample rate (Hz), samples are held; 0: one per step
  double delay = 0.0;  ///< s, rounded to whole steps
  Dropout dropout = {};

  bool operator==(const SensorChannel&) const = default;
};

/// Rotation of the IMU from its nominal frame (rad): about x, then y, then z.
struct Misalignment {
  double roll = 0.0;
  double pitch = 0.0;
  double yaw = 0.0;
  double sd = 0.0;  ///< of a draw per run that is added to each angle

  bool operator==(const Misalignment&) const = default;
};

/// Hip, knee, wheel. Both legs have the same parameters and independent draws.
using JointChannels = std::array<SensorChannel, 3>;
/// x, y, z in the frame of the IMU. The axes share rate, delay and dropout.
using AxisChannels = std::array<SensorChannel, 3>;

/// Error models of all sensors of a robot.
struct SensorProfile {
  JointChannels torque;        ///< N·m
  JointChannels position;      ///< rad
  JointChannels velocity;      ///< rad/s
  AxisChannels accelerometer;  ///< m/s², gravity included
  AxisChannels gyroscope;      ///< rad/s
  /// Errors of the IMU's own attitude, as a rotation about its axes (rad).
  AxisChannels orientation;
  Misalignment misalignment;
  /// The joints of the right leg are reported this much later than those of the left one (s).
  double leg_skew = 0.0;

  bool operator==(const SensorProfile&) const = default;
};

void describe(Fields& fields, SensorProfile& profile);

/// Whether the profile leaves all values unchanged, to the bit.
bool is_ideal(const SensorProfile& profile);
bool is_ideal(const AxisChannels& channels);
bool is_ideal(const SensorChannel& channel);

/// Reads a profile, looked up by `find_resource`. Errors: `InputError` with file:line:column.
SensorProfile find_sensor_profile(const std::filesystem::path& path);

/// The profile as YAML that reads back to the same profile.
std::string to_yaml(const SensorProfile& profile);

/// Returns the profile with one disturbance set to `value`, for sensitivity studies. `key` names
/// the disturbance of
/// - all sensors that can have it (`dropout`, `delay`, `scale`, `low_pass`, `rate`),
/// - the time between legs (`leg_skew`),
/// - one sensor (`torque.white`),
/// - or one channel (`torque.knee.white`).
/// `value` sets the rate of a dropout, the amplitude of a vibration, the frequency of a mount (Hz),
/// the time constant of a low-pass (s), and the standard deviation of scale, bias and coloured
/// noise. Any other disturbance has one number only. Errors: `InputError` for an unknown key, and
/// for a value out of range.
SensorProfile with_value(SensorProfile profile, std::string_view key, double value);

}  // namespace touchdown::noise
