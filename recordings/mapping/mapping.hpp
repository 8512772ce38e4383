#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "models/robot.hpp"

namespace touchdown::recordings {

/// One column of numbers of a foreign log: of a CSV file by its name, of a `.npz` file a whole
/// array with one axis, or one column of an array with two.
struct SourceColumn {
  std::string name;
  std::optional<std::size_t> index = {};

  bool operator==(const SourceColumn&) const = default;
};

/// What a foreign log calls its columns or arrays.
struct SourceNames {
  std::string file;
  bool are_arrays = false;
  std::vector<std::string> names;
};

/// Numbers that belong together: ours = sign · (unit · theirs − zero), one after the other.
struct MappedSignal {
  struct Number {
    std::size_t column = 0;  ///< among `LogMapping::columns`
    double sign = 1.0;
    double zero = 0.0;  ///< in our unit
  };
  std::vector<Number> numbers;
  double unit = 1.0;  ///< one of theirs in ours

  /// Of the number `i`, in a row of the values of `LogMapping::columns`.
  double value(std::span<const double> row, std::size_t i) const {
    const Number& number = numbers[i];
    return number.sign * (unit * row[number.column] - number.zero);
  }
};

/// More time between two rows than any sensor of a robot that balances takes (s): its unit is
/// wrong.
inline constexpr double longest_period = 0.5;

/// Which columns of somebody else's log are which of our signals, and how they differ: in units,
/// signs, order and axes. Joints are in Upkie's order: left hip, knee, wheel, right hip, knee,
/// wheel.
struct LogMapping {
  /// All that are needed, each once.
  std::vector<SourceColumn> columns;

  std::optional<MappedSignal> time;  ///< s; without it a row comes every …
  double period = 0.0;               ///< … s
  MappedSignal position;             ///< 6, rad
  MappedSignal velocity;             ///< 6, rad/s
  MappedSignal torque;               ///< 6, N·m
  /// Left and right wheel (rad/s), as they were commanded.
  std::optional<MappedSignal> wheel_velocity_target;

  MappedSignal orientation;  ///< 4: from the IMU's frame to its reference, w x y z or …
  bool is_w_last = false;    ///< … x y z w
  /// The reference's z axis points up (ROS, ENU) rather than down (Upkie, NED).
  bool reference_is_z_up = false;
  MappedSignal angular_velocity;                    ///< 3, rad/s
  std::optional<MappedSignal> linear_acceleration;  ///< 3, m/s², without gravity
  std::optional<MappedSignal> proper_acceleration;  ///< 3, m/s², as the chip measures it
  /// From the axes of their IMU to those of Upkie's (x back, y left, z down): a rotation.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();

  /// Whether the wheels touch: one number for both, or left and right …
  std::optional<MappedSignal> contact;
  double contact_above = 0.5;  ///< … and they do above this
};

/// Reads a mapping file for the log that has these names. Errors: `InputError` with
/// file:line:column for a key that is unknown or missing, a name that the log has not, a column
/// that is used twice, a number of names, signs or units that does not fit.
LogMapping read_log_mapping(const std::filesystem::path& path, const SourceNames& names);

}  // namespace touchdown::recordings
