#pragma once

#include <array>
#include <filesystem>
#include <limits>
#include <string>

#include "core/yaml.hpp"

namespace touchdown {
class Fields;
}

namespace touchdown::noise {

/// A constant of a run: what is given, and what is drawn from N(0, sd) besides.
struct Constant {
  double value = 0.0;
  double sd = 0.0;

  bool operator==(const Constant&) const = default;
};

/// A sine at the turning frequency of each wheel times `order`, its phase drawn per run.
struct Vibration {
  double amplitude = 0.0;  ///< the channel's unit per rad/s of the wheel's speed
  double order = 1.0;

  bool operator==(const Vibration&) const = default;
};

/// A first-order Gauss-Markov process.
struct ColouredNoise {
  double sd = 0.0;
  double time_constant = 1.0;  ///< s

  bool operator==(const ColouredNoise&) const = default;
};

/// What a sensor says while it says nothing new.
enum class DropKind : int {
  missing,  ///< the record lacks the channel: estimators do not hear of the step
  frozen,   ///< the last value repeats
  nan       ///< not a number
};

struct Dropout {
  DropKind kind = DropKind::frozen;
  double rate = 0.0;     ///< probability per step that a drop begins
  double length = 0.01;  ///< mean of its geometric distribution (s)

  bool operator==(const Dropout&) const = default;
};

/// What lies between a quantity and the number that is reported for it, in the order in which it
/// happens (docs/noise.md has the equations). The defaults change nothing.
struct SensorChannel {
  Constant scale = {};  ///< relative error
  Constant bias = {};   ///< the channel's unit
  double walk = 0.0;    ///< of the bias: its standard deviation after one second
  Vibration vibration = {};
  ColouredNoise coloured = {};
  double low_pass = 0.0;  ///< time constant of the instrument (s); 0: none
  double white = 0.0;     ///< standard deviation at every step
  double range = std::numeric_limits<double>::infinity();  ///< no value beyond plus or minus this
  double resolution = 0.0;                                 ///< step of the values; 0: none
  double rate = 0.0;   ///< of new samples, which are held in between (Hz); 0: one every step
  double delay = 0.0;  ///< s, in whole steps
  Dropout dropout = {};

  bool operator==(const SensorChannel&) const = default;
};

/// How the IMU is turned against its nominal frame (rad): about x, then y, then z.
struct Misalignment {
  double roll = 0.0;
  double pitch = 0.0;
  double yaw = 0.0;
  double sd = 0.0;  ///< of what is drawn per run for each of the three

  bool operator==(const Misalignment&) const = default;
};

/// Hip, knee, wheel; left and right legs are alike, with draws of their own.
using JointChannels = std::array<SensorChannel, 3>;
/// x, y, z in the frame of the IMU. Its axes have one clock: rate, delay and dropout are the same.
using AxisChannels = std::array<SensorChannel, 3>;

/// What a robot's electronics make of what its ideal sensors would say.
struct SensorProfile {
  JointChannels torque;        ///< N·m
  JointChannels position;      ///< rad
  JointChannels velocity;      ///< rad/s
  AxisChannels accelerometer;  ///< m/s², gravity included
  AxisChannels gyroscope;      ///< rad/s
  /// Errors of the IMU's own attitude, as a rotation about its axes (rad).
  AxisChannels orientation;
  Misalignment misalignment;

  bool operator==(const SensorProfile&) const = default;
};

void describe(Fields& fields, SensorProfile& profile);

/// Whether a profile reports what ideal sensors say, to the bit.
bool is_ideal(const SensorProfile& profile);
bool is_ideal(const AxisChannels& channels);
bool is_ideal(const SensorChannel& channel);

/// The profile that something else names, where `find_resource` finds it. Errors: `InputError` with
/// file:line:column.
SensorProfile find_sensor_profile(const std::filesystem::path& path);

/// The profile as YAML that reads back to the same profile.
std::string to_yaml(const SensorProfile& profile);

}  // namespace touchdown::noise
