#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string_view>

#include <Eigen/Core>

#include "estimator/force/closed_legs.hpp"
#include "estimator/signals.hpp"

namespace touchdown {

/// What an accelerometer at rest measures (m/s²).
inline constexpr double gravity_at_rest = 9.81;

/// NaN: not reported.
inline constexpr double not_reported = std::numeric_limits<double>::quiet_NaN();

/// One control step as the robot's software reports it, in its own joint order, signs and units.
/// NaN: not reported.
struct RobotRecord {
  double time = not_reported;
  /// In the robot's order. They must stay valid until the record is assembled.
  std::span<const JointSignals> joints = {};
  /// w x y z, from the IMU's frame to its reference (`AssemblyConfig::reference_is_z_up`).
  std::array<double, 4> orientation = {not_reported, not_reported, not_reported, not_reported};
  /// In the IMU's frame.
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Constant(not_reported);
  /// In the IMU's frame, without gravity …
  Eigen::Vector3d linear_acceleration = Eigen::Vector3d::Constant(not_reported);
  /// … and as the chip measures it, which at rest points up. One of the two is enough.
  Eigen::Vector3d proper_acceleration = Eigen::Vector3d::Constant(not_reported);
  /// Ground velocity that the policy commanded at the previous step (m/s).
  double ground_velocity_command = 0.0;
  /// The commands of the previous step, in the order of `joints`; may be empty. They must stay
  /// valid, too.
  std::span<const JointTarget> targets = {};
};

/// One of our numbers, from one of the robot's. Records, mapping files and loops share this
/// formula.
[[nodiscard]] constexpr double in_our_convention(double theirs, double unit, double scale,
                                                 double sign, double zero = 0.0) noexcept {
  return sign * (scale * (unit * theirs) - zero);
}

/// How one of our joints follows from one of the record's (`in_our_convention`).
struct JointSource {
  std::size_t index = 0;  ///< among the record's joints
  double sign = 1.0;      ///< −1: their joint turns the other way than Upkie's
  double zero = 0.0;      ///< their position at which ours is zero (rad)
  /// Factors beside the units: a gear ratio, or a torque constant (N·m/A). A negative one is for a
  /// velocity or a torque that is counted the other way than the position.
  double position_scale = 1.0;
  double velocity_scale = 1.0;
  double torque_scale = 1.0;
};

/// Which of a record's accelerations is used.
enum class AccelerationSource : int {
  without_gravity,  ///< `linear_acceleration`; the proper one only detects an IMU upside down
  proper,           ///< `proper_acceleration`, from which the orientation removes gravity
};

/// The size of each of the robot's units in ours.
struct RecordUnits {
  double time = 1.0;                 ///< s
  double position = 1.0;             ///< rad
  double velocity = 1.0;             ///< rad/s
  double torque = 1.0;               ///< N·m
  double angular_velocity = 1.0;     ///< of the IMU, rad/s
  double linear_acceleration = 1.0;  ///< of the IMU, m/s²
  double kp = 1.0;                   ///< of position gains, N·m/rad
  double kd = 1.0;                   ///< of velocity gains, N·m·s/rad
};

/// How a robot's records become `Signals`. The defaults are Upkie's. Joints: left hip, knee, wheel,
/// right hip, knee, wheel. Left hip and knee are positive forward, the right leg is their mirror
/// image. Left wheel + and right wheel − drive forward. SI units. IMU: x back, y left, z down, and
/// its reference has z down.
///
/// The assembly makes these assumptions about the IMU, and a robot that breaks one without a word
/// gets wrong beliefs, because only the direction of gravity can be checked:
/// 1. Orientation, angular velocity and both accelerations are in the same frame, that of the IMU,
///    and `axes` states how this frame is mounted on the base. With the default, an IMU with x
///    forward gives roll and yaw rates of the opposite sign.
/// 2. The quaternion (w x y z) turns vectors of that frame to a reference with a vertical z axis.
///    The heading does not matter.
/// 3. The acceleration without gravity is the proper one plus gravity along the same orientation.
///
/// The keys of a mapping file mean the same: `sign`, `zero`, `scale` and `unit` of joints, and
/// `axes`, `rotation` and `reference` of the IMU.
struct AssemblyConfig {
  double sample_rate = 1000.0;  ///< expected rate of the records (Hz)
  std::array<JointSource, 6> joints = {{{0}, {1}, {2}, {3}, {4}, {5}}};
  RecordUnits units = {};
  AccelerationSource acceleration = AccelerationSource::without_gravity;
  /// The reference's z axis points up (ENU, ROS) rather than down (NED, Upkie's).
  bool reference_is_z_up = false;
  /// Rotation from the axes of the robot's IMU to those of Upkie's: row 0 is the direction that
  /// points back, row 1 left and row 2 down, in the axes of the robot's IMU (`signed_axes`).
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  /// A servo that repeats position, velocity and torque to the bit for this long (s) is stale, and
  /// its torque counts as not reported. 0 = never, for simulators without noise. The same time is
  /// for a single signal that stops while the robot moves (`StoppedSignals`).
  double stale_after = 0.25;
  /// A step longer than this (s) is a gap, as for estimators.
  double maximum_gap = 0.02;
  /// How far the mean step may be from 1/sample_rate, as a share of that.
  double rate_tolerance = 0.05;
  /// Time constant of the low-pass that finds the direction of gravity (s).
  double gravity_memory = 0.25;
  /// For legs with closed loops: hips and knees of the record are motors, and become hips and knees
  /// of the wheels' chains. Targets are then not known.
  std::optional<ClosedLegs> closed_legs = {};
};

/// The `AssemblyConfig::axes` of an IMU, from the names of its axes that point back, left and down:
/// each is x, y or z, or with a minus its reverse. An IMU with x forward, y left and z up (REP 103)
/// has
/// {"-x", "y", "-z"}. Zeros for anything but a right-handed order of x, y and z.
[[nodiscard]] Eigen::Matrix3d signed_axes(const std::array<std::string_view, 3>& names) noexcept;

/// Throws InputError for a rate, unit or memory that is not positive, signs other than ±1, zeros
/// and scales that are not finite, scales of 0, axes that are no rotation, negative times.
void check_assembly_config(const AssemblyConfig& config);

/// The measurements of an IMU in Upkie's frames: x back, y left, z down; SI units.
struct ImuSignals {
  /// w x y z, to a reference with z down. Not normalized.
  std::array<double, 4> orientation;
  Eigen::Vector3d angular_velocity;
  Eigen::Vector3d linear_acceleration;  ///< by `AssemblyConfig::acceleration`
  Eigen::Vector3d proper_acceleration;
};

/// The IMU of a record. NaN where it is not reported.
[[nodiscard]] ImuSignals imu_of(const RobotRecord& record, const AssemblyConfig& config) noexcept;

/// The signals of one record alone. A joint or an acceleration that is not reported is NaN. So is
/// the vertical acceleration if the quaternion's length is not one (to a percent).
[[nodiscard]] Signals signals_of(const RobotRecord& record, const AssemblyConfig& config) noexcept;
/// The same with the record's IMU, if it is known already.
[[nodiscard]] Signals signals_of(const RobotRecord& record, const AssemblyConfig& config,
                                 const ImuSignals& imu) noexcept;

/// The component along the world's upward vertical of a vector in the IMU's frame. NaN if the
/// quaternion (w x y z) does not have length one.
[[nodiscard]] double upward(const std::array<double, 4>& orientation, const Eigen::Vector3d& vector,
                            bool reference_is_z_up = false) noexcept;
/// The world's upward vertical in the IMU's frame, by a quaternion to a reference with z down.
[[nodiscard]] Eigen::Vector3d up_in_imu(const std::array<double, 4>& orientation) noexcept;

}  // namespace touchdown
