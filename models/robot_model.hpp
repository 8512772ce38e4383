#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "estimator/force/closed_legs.hpp"
#include "models/actuator.hpp"
#include "models/mjcf/types.hpp"
#include "models/robot.hpp"
#include "models/terrain.hpp"
#include "models/tyre.hpp"

namespace touchdown::models {

/// A joint that a servo keeps at its reference. It is no part of observations and actions:
///
///     torque = clamp(kp·(reference − q) − kd·q̇, ± effort) − friction(q) − viscous·q̇
struct HeldJoint {
  std::string name;  ///< in the file
  int joint = -1;    ///< its number, and its places in mjData::qpos and mjData::qvel
  int qpos_address = -1;
  int dof_address = -1;
  double reference = 0.0;  ///< rad
  double kp = 0.0;         ///< N·m/rad
  double kd = 0.0;         ///< N·m·s/rad
  double effort = 0.0;     ///< torque limit (N·m)
  Actuator actuator;       ///< friction, viscous friction and armature of the file
  std::string kp_source;   ///< where kp is from, for messages
};

/// A leg with closed loops. Its hip and knee are those of the virtual leg
/// (estimator/force/linkage.hpp), which may have no motor.
struct ClosedLeg {
  Linkage linkage;
  std::vector<int> joint;  ///< of each hinge, in the model: hip, knee, then cranks and rods
  std::vector<int> equality;
};

/// A compiled robot on a terrain. Both physics engines and the renderer are built from it.
///
/// Any robot works if its file keeps the contract of docs/guides/robots.md, or if a YAML file names
/// its parts. The model follows touchdown's conventions for axes, signs and zeros, whatever those
/// of the file (models/robot_source.hpp).
struct RobotModel {
  MjModelPtr mj;
  std::string name;  ///< the MJCF's model name
  int base_body = -1;
  Eigen::Vector3d imu_position = Eigen::Vector3d::Zero();  ///< in the base frame (m)
  /// Of each servo's joint: its number, and its places in mjData::qpos and mjData::qvel. −1 for the
  /// hips of legs that have none.
  std::array<int, servo_count> joint = {};
  std::array<int, servo_count> qpos_address = {};
  std::array<int, servo_count> dof_address = {};
  std::array<int, wheel_count> tyre_geom = {};  ///< left, right
  Tyre tyre;                                    ///< tyre model of both wheels
  /// All geoms of each tyre: its `tyre_geom`, then the strips beside it if the tyre has a width.
  std::array<std::vector<int>, wheel_count> tyre_strips = {};
  double wheel_radius = 0.0;                        ///< of the tyres (m)
  std::array<double, servo_count> effort = {};      ///< torque limit of each servo's motor (N·m)
  std::array<Actuator, servo_count> actuator = {};  ///< of each servo
  /// Whether the axis of a servo's joint is the opposite of that in the file.
  std::array<bool, servo_count> is_reversed = {};
  /// What is added to an angle of the file's joint, after its sign, to count from a straight leg
  /// (rad).
  std::array<double, servo_count> zero = {};
  std::array<std::string, servo_count> joint_name;  ///< in the file
  std::vector<HeldJoint> held;                      ///< in the order of the robot's file
  std::vector<std::string> ignored;                 ///< what of the file is not simulated
  std::vector<std::string> warnings;                ///< what of the file may be a mistake

  /// Left and right leg, if they have closed loops.
  std::array<std::optional<ClosedLeg>, wheel_count> closed_leg;
  /// Cranks and rods of closed legs: joints of the left leg, then of the right.
  std::vector<int> linked;
  /// The joints beside the servos': `linked`, then `held`.
  std::vector<int> others() const;
  /// The joint that each motor turns; −1 without one. In open legs this is `joint`. The motors of a
  /// closed leg count as its hip and knee: `effort` and `actuator` are theirs.
  std::array<int, servo_count> motor_joint = {};

  bool has(std::size_t servo) const { return joint[servo] >= 0; }
  /// The angle of a servo's joint at the reference pose, that of the file (rad).
  double reference(std::size_t servo) const { return mj->qpos0[qpos_address[servo]]; }

  /// Address of the base's free joint in mjData::qpos (x y z, then w x y z) and in mjData::qvel.
  int base_qpos() const { return mj->jnt_qposadr[mj->body_jntadr[base_body]]; }
  int base_dof() const { return mj->jnt_dofadr[mj->body_jntadr[base_body]]; }
};

/// The legs of a robot that has closed ones; its motors have the signs and zeros of the file.
ClosedLegs closed_legs(const RobotModel& robot);

/// The file's name of the joint that a servo's motor turns; it has one.
std::string motor_name(const RobotModel& robot, std::size_t servo);

/// Compiles a robot (an MJCF, or a YAML file about an MJCF or URDF: models/robot_description.hpp)
/// together with a terrain. Errors: `InputError` with file:line:column for broken XML, for an
/// element that the contract lacks, and for one that not every engine simulates. `tyre` replaces
/// the one of the robot's file.
///
/// From the first call on, MuJoCo's fatal errors are thrown as `Error` in the whole process, and
/// its warnings are dropped. MuJoCo's own handlers wait for a key press and write files.
RobotModel compile_robot_model(const std::filesystem::path& robot, const Terrain& terrain,
                               const std::optional<Tyre>& tyre = std::nullopt);

/// Writes the pose of the base and the joint positions into mjData::qpos. Cranks and rods of closed
/// legs follow hip and knee, with one motor also the knee; where the loops do not close, they stay
/// at their start.
void write_pose(const RobotModel& robot, const Eigen::Vector3d& position,
                const Eigen::Quaterniond& orientation,
                const std::array<double, servo_count>& joint_position, mjtNum* qpos);

/// Writes the positions of held joints into mjData::qpos; none stand for their references.
void write_held(const RobotModel& robot, std::span<const double> position, mjtNum* qpos);

/// Kinematics and mass matrix of the robot with its base at the origin. Errors: `Error` when memory
/// is out.
MjDataPtr at_pose(const RobotModel& robot, const Eigen::Quaterniond& orientation,
                  const std::array<double, servo_count>& joint_position);

/// The same with all servos at zero and the base upright.
MjDataPtr at_zero(const RobotModel& robot);

/// Likewise at the pose of the robot's file.
MjDataPtr at_reference(const RobotModel& robot);

/// Bits of the robot's collision geoms: they meet the terrain (2, 1) and not each other.
inline constexpr int robot_contype = 1;
inline constexpr int robot_conaffinity = 2;

}  // namespace touchdown::models
