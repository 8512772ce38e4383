#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "models/robot.hpp"

namespace touchdown::logs {

/// Index of each number of a row in `LogValues`. Vectors and quaternions (w x y z) have consecutive
/// indices; the six servos are in the order of `Servo`.
namespace log_slot {
inline constexpr std::size_t wall_time = 0;
inline constexpr std::size_t time = 1;
inline constexpr std::size_t servo = 2;                          // 6 × position, velocity, torque
inline constexpr std::size_t imu_orientation = servo + 18;       // w x y z
inline constexpr std::size_t angular_velocity = servo + 22;      // 3
inline constexpr std::size_t linear_acceleration = servo + 25;   // 3
inline constexpr std::size_t raw_angular_velocity = servo + 28;  // 3
inline constexpr std::size_t raw_acceleration = servo + 31;      // 3
inline constexpr std::size_t pitch = 36;
inline constexpr std::size_t base_angular_velocity = 37;  // 3, the second is the pitch rate
inline constexpr std::size_t base_to_world = 40;          // 3×3, row by row
inline constexpr std::size_t yaw = 49;
inline constexpr std::size_t yaw_rate = 50;
inline constexpr std::size_t command = 51;                          // 6 × six parameters
inline constexpr std::size_t true_position = command + 36;          // 3
inline constexpr std::size_t true_orientation = command + 39;       // w x y z
inline constexpr std::size_t true_linear_velocity = command + 43;   // 3
inline constexpr std::size_t true_angular_velocity = command + 46;  // 3
inline constexpr std::size_t true_imu_velocity = command + 49;      // 3
inline constexpr std::size_t normal_force = command + 52;           // left, right
inline constexpr std::size_t contact_points = command + 54;         // left, right
inline constexpr std::size_t body_touches_terrain = command + 56;
inline constexpr std::size_t joint_torque = command + 57;  // 6: torque on the joints
inline constexpr std::size_t held = command + 63;          // position, velocity, torque of each
inline constexpr std::size_t motor = held + 3 * models::most_held;  // likewise
inline constexpr std::size_t most_motors = 4;                       // of closed legs
inline constexpr std::size_t count = motor + 3 * most_motors;
}  // namespace log_slot

/// All numbers of one control step.
using LogValues = std::array<double, log_slot::count>;

/// One known key of Upkie's log layout.
struct LogKey {
  enum class Role {
    needed,       ///< required by every estimator
    optional,     ///< has a default or can be derived; always written
    truth,        ///< ground truth; written for simulated runs
    joint_truth,  ///< written if joint torques differ from reported ones
    held_truth,   ///< written for the held joints that the robot has
    motor,        ///< written for the motors of closed legs
    alias,        ///< key of another version of Upkie; only read
  };
  std::string path;  ///< dotted
  std::size_t slot = 0;
  std::size_t size = 1;
  Role role = Role::optional;
  bool is_flag = false;  ///< true or false instead of a number
};

/// All keys that are read or written, in writing order.
const std::vector<LogKey>& log_keys();

/// Keys as a tree, like the nested maps of a record. Node 0 is the record itself.
class LogKeyTree {
 public:
  static constexpr int none = -1;

  struct Node {
    std::string name;
    std::vector<int> children;
    const LogKey* key = nullptr;  ///< may be null; a node may have a key and children
  };

  /// Builds the tree of those keys of `log_keys()` for which `wanted` is true.
  explicit LogKeyTree(const std::function<bool(const LogKey&)>& wanted);

  const Node& node(int index) const { return nodes_[static_cast<std::size_t>(index)]; }
  std::size_t size() const { return nodes_.size(); }

 private:
  std::vector<Node> nodes_;
};

/// One control step of a log.
struct LogRow {
  models::Observation observation;
  models::Action action;
  /// Only if the log has the true state of the base. If the log has contact points but no forces,
  /// normal forces are 0 or infinity; without contacts they are NaN.
  std::optional<models::GroundTruth> truth;
};

/// Marks the values that a record has.
using LogPresence = std::bitset<log_slot::count>;

/// Converts a step to flat numbers, without loss. `truth` may be null.
LogValues to_values(const models::Observation& observation, const models::Action& action,
                    const models::GroundTruth* truth);

/// The time of a record (s): that of its observation, or else its own.
double time_of(const LogValues& values, const LogPresence& present);

/// The inverse. Absent values get their default or are derived from the IMU.
LogRow to_row(const LogValues& values, const LogPresence& present);

}  // namespace touchdown::logs
