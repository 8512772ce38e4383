#include "scenarios/start_pose.hpp"

#include <cmath>

#include "core/error.hpp"
#include "scenarios/scenario.hpp"

namespace touchdown {

namespace {

struct Kinematics {
  Eigen::Vector3d centre_of_mass;
  Eigen::Vector3d axle;  ///< midway between the tyres' centres
};

Kinematics kinematics(const RobotModel& model, mjData& data, const RobotState& state) {
  const auto joint = static_cast<std::size_t>(model.mj->body_jntadr[model.base_body]);
  mjtNum* q = &data.qpos[model.mj->jnt_qposadr[joint]];
  for (int i = 0; i < 3; ++i) q[i] = state.position[i];
  q[3] = state.orientation.w();
  q[4] = state.orientation.x();
  q[5] = state.orientation.y();
  q[6] = state.orientation.z();
  for (std::size_t i = 0; i < servo_count; ++i) {
    data.qpos[model.qpos_address[i]] = state.joint_position[i];
  }
  mj_kinematics(model.mj.get(), &data);
  mj_comPos(model.mj.get(), &data);
  const mjtNum* com = &data.subtree_com[3 * model.base_body];
  const mjtNum* left = &data.geom_xpos[3 * model.tyre_geom[0]];
  const mjtNum* right = &data.geom_xpos[3 * model.tyre_geom[1]];
  return {{com[0], com[1], com[2]},
          0.5 * (Eigen::Vector3d(left[0], left[1], left[2]) +
                 Eigen::Vector3d(right[0], right[1], right[2]))};
}

}  // namespace

RobotState start_pose(const RobotModel& model, const Terrain& terrain, const Start& start) {
  const MjDataPtr data(mj_makeData(model.mj.get()));
  if (!data) throw Error("MuJoCo could not make its data: out of memory");
  RobotState state;
  // The left hip swings the foot forward and the knee folds it back under the hip.
  state.joint_position = {start.hip, -start.knee, 0.0, -start.hip, start.knee, 0.0};

  const Kinematics upright = kinematics(model, *data, state);
  const Eigen::Vector3d lever = upright.centre_of_mass - upright.axle;
  const double pitch = -std::atan2(lever.x(), lever.z());
  state.orientation = Eigen::AngleAxisd(start.yaw, Eigen::Vector3d::UnitZ()) *
                      Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY());

  const Kinematics balanced = kinematics(model, *data, state);
  const Eigen::Vector3d wheels(start.x, start.y,
                               height_at(terrain, start.x) + model.wheel_radius + start.clearance);
  state.position = wheels - balanced.axle;
  return state;
}

}  // namespace touchdown
