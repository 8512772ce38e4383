#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace touchdown::logs {

inline constexpr const char* joint_state_type = "sensor_msgs/msg/JointState";
inline constexpr const char* imu_type = "sensor_msgs/msg/Imu";

/// When a message was measured.
struct MessageStamp {
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
  bool is_zero() const { return sec == 0 && nanosec == 0; }
  /// ns
  std::int64_t time() const { return std::int64_t{1'000'000'000} * sec + nanosec; }
};

/// sensor_msgs/msg/JointState. Each list of numbers is empty or has one per name;
/// of some drivers, the list of names is empty.
struct JointState {
  MessageStamp stamp;
  std::vector<std::string_view> name;  ///< into the payload
  std::vector<double> position;        ///< rad
  std::vector<double> velocity;        ///< rad/s
  std::vector<double> effort;          ///< N·m
};

/// sensor_msgs/msg/Imu. Signals that are not given, by a covariance that begins with −1 or by a
/// quaternion of zeros, are NaN.
struct ImuState {
  MessageStamp stamp;
  std::array<double, 4> orientation{};          ///< x y z w
  std::array<double, 3> angular_velocity{};     ///< rad/s
  std::array<double, 3> linear_acceleration{};  ///< m/s², gravity included
};

/// Decode a message's payload in CDR. Errors: `InputError` for a malformed payload.
void decode(std::string_view payload, JointState& state);
void decode(std::string_view payload, ImuState& state);

}  // namespace touchdown::logs
