#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/fields.hpp"
#include "core/key.hpp"
#include "estimator/force/closed_legs.hpp"
#include "estimator/record.hpp"
#include "logs/log/row.hpp"
#include "models/robot.hpp"
#include "models/robot_model.hpp"

namespace touchdown::logs {

/// Sources with clocks of their own that a mapping joins: files of one folder, or topics of a bag.
struct LogSources {
  std::vector<std::string> joints;   ///< of a bag, empty: the only topic of JointState
  std::vector<std::string> imu;      ///< of a bag, empty: the only topic of Imu
  std::vector<std::string> contact;  ///< empty: among the joints' columns
  double stale_after = 0.05;         ///< older values are missing (s)

  bool empty() const { return joints.empty() && imu.empty(); }  ///< the log is one file, or a bag
  /// Whether they are named like files, not like topics.
  bool are_files() const;
  /// The names in all sections.
  std::vector<std::string> all() const;
};

/// Reads only `sources` of a mapping file. Errors: `InputError` with file:line:column, also for
/// unknown keys of other sections.
LogSources read_log_sources(const std::filesystem::path& mapping);

/// One column of numbers of another robot's log: a named column of a CSV file, a whole `.npz` array
/// with one axis, or one column of an array with two.
struct SourceColumn {
  std::string name;
  std::optional<std::size_t> index = {};
  std::size_t source = 0;  ///< index of its source, of a log with several
  /// What a double does not hold of the column's numbers, such as nanoseconds since 1970.
  bool is_rest = false;

  bool operator==(const SourceColumn&) const = default;
};

/// Names of the columns or arrays of another robot's log, or of one of its sources.
struct SourceNames {
  std::string file;
  bool are_arrays = false;
  std::vector<std::string> names;
  /// The section of the mapping that a source belongs to: joints, imu or contact. Empty: all.
  std::string section = {};
  bool is_topic = false;  ///< of a bag
  bool is_imu = false;    ///< of sensor_msgs/msg/Imu, with its names and conventions
  /// Whether columns NAME/position, NAME/velocity and NAME/effort follow from the names of joints
  /// in the rows: of a topic, or of a file with such names.
  bool has_joint_names = false;
  /// The numbers of rows and columns of an array; 1 column for one axis. May be empty: unknown.
  std::function<std::array<std::size_t, 2>(const std::string& name)> shape = {};
};

/// The numbers of one signal, converted by `in_our_convention`.
struct MappedSignal {
  /// The column of a number that the robot lacks: it is 0.
  static constexpr std::size_t no_column = std::numeric_limits<std::size_t>::max();

  struct Number {
    std::size_t column = 0;  ///< among `LogMapping::columns`
    double sign = 1.0;
    double zero = 0.0;  ///< in the unit of touchdown
    double scale = 1.0;
  };
  std::vector<Number> numbers;
  double unit = 1.0;  ///< the unit of the log in the unit of touchdown

  /// Number `i`, from a row with the values of `LogMapping::columns`.
  double value(std::span<const double> row, std::size_t i) const {
    const Number& number = numbers[i];
    if (number.column == no_column) return 0.0;
    return in_our_convention(row[number.column], unit, number.scale, number.sign, number.zero);
  }
};

/// When a row was logged.
struct SourceClock {
  MappedSignal time;                    ///< s
  std::optional<std::size_t> rest;      ///< column of what a double does not hold of it
  std::optional<MappedSignal> nanosec;  ///< added to it (ns)

  /// s, from a row with the values of `LogMapping::columns`.
  double at(std::span<const double> row) const {
    return time.value(row, 0) + (nanosec ? 1e-9 * nanosec->value(row, 0) : 0.0);
  }
  /// The same in ns, with every digit of the log.
  std::int64_t stamp(std::span<const double> row) const;
};

/// Longest plausible time between two rows (s). A longer one indicates a wrong unit of time.
inline constexpr double longest_period = 0.5;

/// Commands of the servos of hips and knees: left hip, knee, right hip, knee.
struct MappedLegTargets {
  MappedSignal position;                 ///< rad
  std::optional<MappedSignal> velocity;  ///< rad/s; without it 0
  std::optional<MappedSignal> torque;    ///< feed-forward, N·m; without it 0
  std::array<double, 4> kp = {};         ///< gains: N·m/rad
  std::array<double, 4> kd = {};         ///< N·m·s/rad
};

/// Turns what motors of closed legs report into hips and knees of their virtual legs
/// (estimator/force/closed_legs.hpp), row by row. Motors and wheels count with the signs and zeros
/// of the robot's file.
class MotorsToLegs {
 public:
  /// Errors: those of `compile_robot_model`; `InputError` for a robot with open legs.
  explicit MotorsToLegs(const std::filesystem::path& robot);

  std::size_t motors_per_leg() const;
  /// "left_front, left_rear, left_axle, right_front, …": the order of a mapping's joints.
  std::string joints() const;

  /// Replaces motors in the slots of hips and knees by the virtual legs, and keeps them as motors.
  /// A leg with one motor has it in the slot of its hip. Where loops cannot close, or a number is
  /// missing, the leg's numbers are NaN.
  void convert(LogValues& values);

 private:
  models::RobotModel robot_;
  ClosedLegs legs_;
};

/// Maps the columns of another robot's log to signals, with units, signs, order and axes. Joints
/// are in Upkie's order: left hip, knee, wheel, right hip, knee, wheel.
struct LogMapping {
  /// All needed columns, each once.
  std::vector<SourceColumn> columns;

  std::filesystem::path folder;  ///< of the mapping file
  std::string robot;             ///< its name; empty if unknown
  LogSources sources;
  std::optional<SourceClock> time;  ///< of the joints
  double period = 0.0;              ///< between rows, without `time` (s)
  /// The clock of each source, of a log with several.
  std::vector<SourceClock> clocks;
  MappedSignal position;  ///< 6, rad
  MappedSignal velocity;  ///< 6, rad/s
  MappedSignal torque;    ///< 6, N·m
  /// For legs with closed loops: the numbers of hips and knees are those of their motors. It
  /// remembers the last row.
  std::shared_ptr<MotorsToLegs> closed_legs;
  /// Commanded velocity of the left and right wheel (rad/s).
  std::optional<MappedSignal> wheel_velocity_target;
  std::optional<MappedLegTargets> leg_targets;

  MappedSignal orientation;       ///< 4: from the IMU frame to its reference, w x y z
  bool is_w_last = false;         ///< order x y z w instead
  MappedSignal angular_velocity;  ///< 3, rad/s
  std::optional<MappedSignal> linear_acceleration;  ///< 3, m/s², without gravity
  std::optional<MappedSignal> proper_acceleration;  ///< 3, m/s², gravity included
  /// The frames of the IMU; which of the two accelerations is used. Numbers above have the units of
  /// touchdown.
  AssemblyConfig conventions;

  /// The source of the joints' rows, of a log with several: that of the first joint.
  std::size_t joint_source() const;

  /// Contact labels: one number for both wheels, or left and right.
  std::optional<MappedSignal> contact;
  double contact_above = 0.5;  ///< a number above this is contact
};

/// Reads a mapping file for a log with these names; a log with several sources has several. Contact
/// labels may be left out, as a robot's loop has none. Errors:
/// `InputError` with file:line:column for
/// - an unknown or missing key;
/// - a name that the log lacks, or a column that is used twice;
/// - a wrong number of names, signs or units.
LogMapping read_log_mapping(const std::filesystem::path& path, std::span<const SourceNames> sources,
                            bool with_labels = true);

/// The keys of a mapping file.
std::vector<Key> mapping_keys();

}  // namespace touchdown::logs
