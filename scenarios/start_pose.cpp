#include "scenarios/start_pose.hpp"

#include <cmath>

#include "core/error.hpp"
#include "models/profile.hpp"

namespace touchdown::scenarios {

namespace {

struct Kinematics {
  Eigen::Vector3d centre_of_mass;
  Eigen::Vector3d axle;  ///< midway between the tyres' centres
};

Kinematics kinematics(const models::RobotModel& model, mjData& data,
                      const simulators::RobotState& state) {
  models::write_pose(model, state.position, state.orientation, state.joint_position, data.qpos);
  mj_kinematics(model.mj.get(), &data);
  mj_comPos(model.mj.get(), &data);
  return {models::vector_at(data.subtree_com, model.base_body),
          0.5 * (models::vector_at(data.geom_xpos, model.tyre_geom[0]) +
                 models::vector_at(data.geom_xpos, model.tyre_geom[1]))};
}

}  // namespace

simulators::RobotState start_pose(const models::RobotModel& model, const models::Terrain& terrain,
                                  const Start& start) {
  const models::MjDataPtr data(mj_makeData(model.mj.get()));
  if (!data) throw Error("MuJoCo could not make its data: out of memory");
  simulators::RobotState state;
  // The left hip swings the foot forward and the knee folds it back under the hip.
  state.joint_position = {start.hip, -start.knee, 0.0, -start.hip, start.knee, 0.0};

  const Kinematics upright = kinematics(model, *data, state);
  const Eigen::Vector3d lever = upright.centre_of_mass - upright.axle;
  const double pitch = -std::atan2(lever.x(), lever.z());
  state.orientation = Eigen::AngleAxisd(start.yaw, Eigen::Vector3d::UnitZ()) *
                      Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY());

  const Kinematics balanced = kinematics(model, *data, state);
  const Eigen::Vector3d wheels(
      start.x, start.y,
      models::Profile(terrain).height(start.x) + model.wheel_radius + start.clearance);
  state.position = wheels - balanced.axle;
  return state;
}

}  // namespace touchdown::scenarios
