#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "logs/bags/message.hpp"
#include "logs/bags/source_join.hpp"
#include "logs/held_number.hpp"
#include "logs/log/notes.hpp"

namespace touchdown::logs {

/// The columns with the time of a message (s): its own stamp, or when it was recorded.
inline constexpr const char* stamp_column = "header.stamp";
inline constexpr const char* log_time_column = "log_time";

inline constexpr const char* joint_state_type = "sensor_msgs/msg/JointState";
inline constexpr const char* imu_type = "sensor_msgs/msg/Imu";

/// The definition of `joint_state_type`, with those that it uses.
inline constexpr const char* joint_state_definition = R"(std_msgs/Header header
string[] name
float64[] position
float64[] velocity
float64[] effort
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
)";
/// The lists of its messages.
inline constexpr std::array<const char*, 3> joint_fields = {"position", "velocity", "effort"};

/// A header without a stamp was sent now, unless the clock is a simulation's, which starts at zero.
inline constexpr double longest_delay = 60.0;  // s

/// The numbers and texts of a message of any type, in the order of their definition.
struct MessageNumbers {
  std::vector<double> values;
  std::vector<std::string_view> texts;  ///< into the payload
  std::vector<std::string> paths;       ///< of each: "motor_state[0].tau_est"
  std::vector<std::uint32_t> lengths;  ///< of the lists without a fixed length; the paths depend on
                                       ///< nothing else

  /// The stamp with which the message begins (ns); zero without one.
  std::int64_t stamp() const;
  /// The names of a JointState's joints; empty for some drivers.
  std::span<const std::string_view> joints() const { return std::span(texts).subspan(1); }
};

/// A type of messages: JointState, Imu, or another one by the definition that a bag carries. It
/// decodes numbers, flags and texts; lists of more than 1024 numbers, such as images, are skipped.
/// Signals that an Imu does not give, by a covariance that begins with −1 or by a quaternion of
/// zeros, are NaN.
class MessageType {
 public:
  /// `definition` is that of ROS 2's .msg files, followed by those of the types that it uses, each
  /// behind a line of "=" and a line "MSG: package/Type". Errors: `InputError` that names the line
  /// for a definition that is another one, is missing, or contains itself. Those of JointState and
  /// Imu are known.
  MessageType(const std::string& name, std::string_view definition);

  /// Decodes a message's payload in CDR. `numbers` are those of the message before. Returns whether
  /// they have other lists or paths now. Errors: `InputError` for a malformed payload, and for a
  /// JointState with lists of different lengths.
  bool decode(std::string_view payload, MessageNumbers& numbers) const;

 private:
  friend class TypeParser;
  friend class NumberReader;

  enum class Array { none, fixed, sequence };
  struct Field {
    std::string name;
    std::size_t type = 0;  ///< a primitive type, or behind them one of `structs_`
    Array array = Array::none;
    std::size_t length = 0;  ///< of a fixed array
  };
  using Struct = std::vector<Field>;

  std::string name_;
  std::vector<Struct> structs_;
};

/// A topic of sensor_msgs/msg/JointState, sensor_msgs/msg/Imu, or of another type that the bag
/// defines, as the beginning of a bag shows it.
struct SignalTopic {
  std::string name;
  std::string type;
  std::vector<std::string> joints;  ///< of JointState, in the order of their first message
  std::size_t width = 0;            ///< of JointState: the largest number of positions, …
  bool has_velocity = false;        ///< of JointState
  bool has_effort = false;          ///< of JointState
  bool has_orientation = false;     ///< of Imu
  std::shared_ptr<const MessageType> definition;
  std::vector<std::string> numbers;  ///< of another type
  std::vector<double> stamp_delays;  ///< times of recording − stamps that are not zero (s) …
  double stamp_delay = 0.0;          ///< … and their median: a single one may be wrong
  std::uint64_t messages = 0;        ///< decoded so far
  std::string fault;                 ///< of the last message that cannot be decoded

  /// Names of all numbers of a message: `stamp_column`, `log_time_column`; NAME/position,
  /// NAME/velocity, NAME/effort for each joint, and position[0], velocity[0], effort[0], …; or
  /// orientation.x, …, linear_acceleration.z; or the paths of another type's numbers.
  std::vector<std::string> columns() const;
};

/// A line if the stamps of a topic are of another clock than those of the joints, else none.
std::vector<std::string> clock_notes(const SignalTopic& topic, const SignalTopic& joints);

/// A number of a message, or what a double does not hold of its time.
struct TopicColumn {
  std::string name;
  bool is_rest = false;
};

/// Decodes the messages of one topic to rows of selected columns.
class TopicRows {
 public:
  struct Config {
    bool uses_log_time = false;  ///< instead of stamps
    double stale_after = 0.05;   ///< s
  };

  TopicRows(SignalTopic topic, std::vector<TopicColumn> columns, const Config& config);

  /// Decodes the message. Returns whether it is a row: a JointState with the first of the selected
  /// joints, or any message of another type. Values that a JointState does not give, as from a
  /// driver that sends a part of the joints, or some efforts, are the latest ones if they are not
  /// stale, otherwise NaN. A malformed message is counted and gives no row.
  bool update(const BagMessage& message);

  std::span<const double> row() const { return row_; }
  double time() const { return time_; }

  std::uint64_t malformed() const { return malformed_; }
  /// Adds what a user should know about the messages, and a finding for several publishers with
  /// the same joints.
  void add_to(LogNotes& notes) const;

 private:
  std::string publishers() const;
  /// The two latest values of a number: messages can come in another order than their stamps.
  using Held = std::array<HeldNumber, 2>;
  void find_columns();
  void count_kind();
  void hold(std::size_t column);

  SignalTopic topic_;
  Config config_;
  std::vector<double> row_;
  double time_ = 0.0;
  MessageNumbers numbers_;              ///< of the last message
  std::vector<TopicColumn> columns_;    ///< the selected ones; of joints, the first makes rows
  std::vector<Held> held_;              ///< by column
  bool has_log_time_;                   ///< whether a column is `log_time_column`
  std::vector<std::string> names_;      ///< the message's texts, for which these are found:
  std::vector<std::size_t> number_at_;  ///< of the columns among the numbers
  bool is_row_ = true;
  /// Of messages with the first joint: the number by their names, and how often they change.
  std::map<std::vector<std::string>, std::uint64_t> kinds_;
  std::vector<std::string> last_kind_;
  std::uint64_t alternations_ = 0;
  Ages ages_;  ///< of the values from earlier messages
  std::uint64_t malformed_ = 0;
  std::string first_malformed_;
};

/// The topics of these names in a bag. Errors: `InputError`, which lists the bag's topics with
/// their types and numbers of messages, for a topic that is not there, has another type or
/// encoding, or has no readable message; as in `BagReader`, also for `stop`.
std::vector<SignalTopic> find_signal_topics(const std::filesystem::path& bag,
                                            const std::vector<std::string>& names,
                                            const std::atomic<bool>* stop = nullptr);

/// The only topic of this type in a bag. Errors: `InputError` as above if it has none or several.
std::string only_topic_of_type(const std::filesystem::path& bag, const std::string& type,
                               const std::atomic<bool>* stop = nullptr);

}  // namespace touchdown::logs
