#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace touchdown::models {

/// The six servos of a wheeled biped, in the order of all arrays, files and columns.
enum class Servo : int { left_hip, left_knee, left_wheel, right_hip, right_knee, right_wheel };

inline constexpr int servo_count = 6;
inline constexpr int wheel_count = 2;
/// The largest number of held joints (models/robot_model.hpp).
inline constexpr int most_held = 8;

inline constexpr std::array<std::string_view, servo_count> servo_names = {
    "left_hip", "left_knee", "left_wheel", "right_hip", "right_knee", "right_wheel"};

/// Index of a servo in the arrays below.
constexpr std::size_t index(Servo servo) { return static_cast<std::size_t>(servo); }

/// The wheel servos by leg: left, right.
inline constexpr std::array<Servo, wheel_count> wheel_servos = {Servo::left_wheel,
                                                                Servo::right_wheel};

/// Servo gains for scales of one, as Upkie's spine sets them.
inline constexpr double servo_kp = 20.0;  ///< N·m/rad
inline constexpr double servo_kd = 1.0;   ///< N·m·s/rad

/// Command to one servo, as in Upkie's spine (rad, rad/s, N·m).
/// torque = clamp(feedforward + kd·kd_scale·(velocity − ω) + kp·kp_scale·(position − q)); a NaN
/// position drops the position term.
struct ServoCommand {
  double feedforward_torque = 0.0;
  double position = std::numeric_limits<double>::quiet_NaN();
  double velocity = 0.0;
  double kp_scale = 1.0;
  double kd_scale = 1.0;
  double maximum_torque = std::numeric_limits<double>::infinity();
};

/// The output of a policy for one observation.
struct Action {
  std::array<ServoCommand, servo_count> servo;
};

/// Measurement of one servo (rad, rad/s, N·m). `torque` is the servo's estimate from its current
/// for the last step. With an ideal actuator it is the torque on the joint.
struct ServoReading {
  double position = 0.0;
  double velocity = 0.0;
  double torque = 0.0;
};

/// The IMU's frame in the base frame, in all recordings: x back, y left, z down, as on Upkie. An
/// IMU that is mounted otherwise is read in this frame.
inline Eigen::Quaterniond imu_convention() { return {0.0, 0.0, 1.0, 0.0}; }

/// Measurement of the IMU, in the frame above.
struct ImuReading {
  /// From the IMU frame to the attitude reference system (x forward, y right, z down).
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  /// In the IMU frame (rad/s).
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();
  /// In the IMU frame, gravity removed (m/s²): the IMU's velocity differenced over one step.
  Eigen::Vector3d linear_acceleration = Eigen::Vector3d::Zero();
  /// Proper acceleration in the IMU frame (m/s²): the accelerometer's raw output.
  Eigen::Vector3d raw_linear_acceleration = Eigen::Vector3d::Zero();
};

/// Everything that the robot measures at one control step. It contains no ground truth.
struct Observation {
  /// Time since the reset (s): the step count times the control period.
  double time = 0.0;
  std::array<ServoReading, servo_count> servo;
  /// Motors of closed legs, those of the left leg first; empty for open legs. `servo` has the
  /// virtual legs (estimator/force/linkage.hpp), as they follow from the motors.
  std::vector<ServoReading> motor = {};
  ImuReading imu;
  /// Pitch of the base, positive when it leans forward (rad), and its rate (rad/s), from the IMU.
  double pitch = 0.0;
  double pitch_rate = 0.0;
  /// Heading of the base, positive to the left (rad), and its rate (rad/s), from the IMU.
  double yaw = 0.0;
  double yaw_rate = 0.0;
};

/// State that only the simulator knows. World frame: x forward, y left, z up, origin on the floor.
struct GroundTruth {
  /// Position of the base frame in the world (m).
  Eigen::Vector3d base_position = Eigen::Vector3d::Zero();
  /// From the base frame (x forward, y left, z up) to the world.
  Eigen::Quaterniond base_orientation = Eigen::Quaterniond::Identity();
  /// Of the base frame's origin, in the world (m/s).
  Eigen::Vector3d base_linear_velocity = Eigen::Vector3d::Zero();
  /// In the world (rad/s).
  Eigen::Vector3d base_angular_velocity = Eigen::Vector3d::Zero();
  /// Of the IMU, in the world (m/s).
  Eigen::Vector3d imu_linear_velocity = Eigen::Vector3d::Zero();
  /// Normal force between each tyre and the terrain, averaged over the last step (N).
  std::array<double, wheel_count> wheel_normal_force = {0.0, 0.0};
  /// Whether a part other than a tyre touches the terrain: the robot has fallen.
  bool body_touches_terrain = false;
  /// Torque of each actuator on its joint over the last physics step (N·m), friction included
  /// (models/actuator.hpp). Empty with ideal actuators, where the servo reports this torque.
  std::optional<std::array<double, servo_count>> joint_torque = {};
  /// Held joints (models/robot_model.hpp): position (rad), velocity (rad/s) and the torque of the
  /// last physics step (N·m). Empty for robots without any.
  std::vector<ServoReading> held = {};
};

/// The projection of the IMU's acceleration on the world's upward vertical (m/s²): γ^z of the
/// paper. The attitude reference system's z axis points down, hence the sign.
inline double vertical_acceleration(const ImuReading& imu) {
  return -(imu.orientation * imu.linear_acceleration).z();
}

}  // namespace touchdown::models
