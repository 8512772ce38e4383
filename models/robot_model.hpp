#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <mujoco/mujoco.h>

#include "models/actuator.hpp"
#include "models/robot.hpp"
#include "models/terrain.hpp"
#include "models/tyre.hpp"

namespace touchdown::models {

struct MjModelDeleter {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
};
using MjModelPtr = std::unique_ptr<mjModel, MjModelDeleter>;

struct MjDataDeleter {
  void operator()(mjData* data) const { mj_deleteData(data); }
};
using MjDataPtr = std::unique_ptr<mjData, MjDataDeleter>;

// Rows of MuJoCo's arrays as Eigen vectors and quaternions. MuJoCo stores quaternions as w x y z.

inline Eigen::Vector3d vector_at(const mjtNum* x, int row) {
  return {x[3 * row], x[3 * row + 1], x[3 * row + 2]};
}
inline Eigen::Quaterniond quaternion_at(const mjtNum* x, int row) {
  return {x[4 * row], x[4 * row + 1], x[4 * row + 2], x[4 * row + 3]};
}

/// A compiled robot on a terrain. Both physics engines and the renderer are built from it.
///
/// Any robot works if its MJCF keeps the naming contract:
/// - one free-floating base body with exactly six hinge joints and six motors, named as in
///   `servo_names`;
/// - a site `imu` on the base body;
/// - geoms `left_tire` and `right_tire` on the bodies that the wheel joints move.
/// touchdown uses no other names of the robot.
struct RobotModel {
  MjModelPtr mj;
  std::string name;  ///< the MJCF's model name
  int base_body = -1;
  int imu_site = -1;
  std::array<int, servo_count> qpos_address = {};  ///< of each servo's joint in mjData::qpos
  std::array<int, servo_count> dof_address = {};   ///< of each servo's joint in mjData::qvel
  std::array<int, wheel_count> tyre_geom = {};     ///< left, right
  Tyre tyre;                                       ///< tyre model of both wheels
  /// All geoms of each tyre: its `tyre_geom`, then the strips beside it if the tyre has a width.
  std::array<std::vector<int>, wheel_count> tyre_strips = {};
  double wheel_radius = 0.0;                        ///< of the tyres (m)
  std::array<double, servo_count> effort = {};      ///< torque limit of each servo's motor (N·m)
  std::array<Actuator, servo_count> actuator = {};  ///< of each servo

  /// Address of the base's free joint in mjData::qpos (x y z, then w x y z) and in mjData::qvel.
  int base_qpos() const { return mj->jnt_qposadr[mj->body_jntadr[base_body]]; }
  int base_dof() const { return mj->jnt_dofadr[mj->body_jntadr[base_body]]; }
};

/// Compiles a robot (an MJCF, or a YAML file about one: models/robot_description.hpp) together with
/// a terrain. Errors: `InputError` with file:line:column for broken XML; `InputError` that names
/// the missing element if the model does not keep the contract.
///
/// From the first call on, MuJoCo's fatal errors are thrown as `Error` in the whole process, and
/// its warnings are dropped. MuJoCo's own handlers wait for a key press and write files.
RobotModel compile_robot_model(const std::filesystem::path& robot, const Terrain& terrain);

/// Writes the pose of the base and the joint positions into mjData::qpos.
void write_pose(const RobotModel& robot, const Eigen::Vector3d& position,
                const Eigen::Quaterniond& orientation,
                const std::array<double, servo_count>& joint_position, mjtNum* qpos);

/// Kinematics of the robot with all joints at zero and the base upright at the origin. Errors:
/// `Error` when memory is out.
MjDataPtr at_zero(const RobotModel& robot);

}  // namespace touchdown::models
