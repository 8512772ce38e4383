#include "scenarios/start_pose.hpp"

#include <cmath>

#include <Eigen/LU>
#include <fmt/format.h>

#include "core/error.hpp"
#include "models/profile.hpp"
#include "models/stance.hpp"

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

/// A point seen from the side: x and z.
Eigen::Vector2d from_the_side(const mjtNum* x, int row) { return {x[3 * row], x[3 * row + 2]}; }

/// Hip and knee of one leg, by servo.
struct Leg {
  std::size_t hip, knee;
  int tyre;
};

/// Bends a leg by Newton's method until its tyre is at `target`, seen from the side of the upright
/// base. Returns whether that succeeded. The leg starts with some extra bend, its knee on the side
/// of `forward` (±1): a straight leg is singular.
bool reach(const models::RobotModel& model, mjData& data, simulators::RobotState& state,
           const Leg& leg, const Eigen::Vector2d& target, double forward) {
  constexpr double more_hip = 0.2;
  constexpr double more_knee = 0.35;
  state.joint_position[leg.hip] += forward * more_hip;
  state.joint_position[leg.knee] -= forward * more_knee;
  const int body = model.mj->geom_bodyid[leg.tyre];
  Eigen::Matrix<mjtNum, 3, Eigen::Dynamic, Eigen::RowMajor> jacobian(3, model.mj->nv);
  constexpr int most_steps = 50;
  for (int step = 0; step < most_steps; ++step) {
    kinematics(model, data, state);
    const Eigen::Vector2d missing = target - from_the_side(data.geom_xpos, leg.tyre);
    if (missing.norm() < 1e-12) {
      return can_turn(model, leg.hip, state.joint_position[leg.hip]) &&
             can_turn(model, leg.knee, state.joint_position[leg.knee]);
    }
    mj_jac(model.mj.get(), &data, jacobian.data(), nullptr, &data.geom_xpos[3 * leg.tyre], body);
    Eigen::Matrix2d turn;
    turn << jacobian(0, model.dof_address[leg.hip]), jacobian(0, model.dof_address[leg.knee]),
        jacobian(2, model.dof_address[leg.hip]), jacobian(2, model.dof_address[leg.knee]);
    const Eigen::Vector2d change = turn.partialPivLu().solve(missing);
    state.joint_position[leg.hip] += change[0];
    state.joint_position[leg.knee] += change[1];
  }
  return false;
}

/// Aligns the wheels of legs of different lengths. The shorter leg keeps its angles; the longer one
/// bends at hip and knee until both wheels share one axle.
void line_up(const models::RobotModel& model, mjData& data, simulators::RobotState& state) {
  const std::array<Leg, 2> legs = {
      Leg{models::index(models::Servo::left_hip), models::index(models::Servo::left_knee),
          model.tyre_geom[0]},
      Leg{models::index(models::Servo::right_hip), models::index(models::Servo::right_knee),
          model.tyre_geom[1]}};
  std::array<Eigen::Vector2d, 2> tyre;
  std::array<double, 2> length;
  for (std::size_t i = 0; i < legs.size(); ++i) {
    const int top = model.joint[model.has(legs[i].hip) ? legs[i].hip : legs[i].knee];
    tyre[i] = from_the_side(data.geom_xpos, legs[i].tyre);
    length[i] = (tyre[i] - from_the_side(data.xanchor, top)).norm();
  }
  if ((tyre[0] - tyre[1]).norm() < 1e-9) return;
  const std::size_t longer = length[0] > length[1] ? 0 : 1;
  const bool backward = state.joint_position[models::index(models::Servo::right_knee)] < 0.0;
  const double forward = (longer == 0) == backward ? -1.0 : 1.0;
  if (!model.has(legs[longer].hip) ||
      !reach(model, data, state, legs[longer], tyre[1 - longer], forward)) {
    throw InputError(fmt::format(
        "{}: its legs differ too much to stand on one axle, however the longer one bends",
        model.name));
  }
}

}  // namespace

simulators::RobotState start_pose(const models::RobotModel& model, const models::Terrain& terrain,
                                  const Start& start) {
  const models::MjDataPtr data = models::make_data(*model.mj);
  simulators::RobotState state;
  // The left hip swings the foot forward and the knee folds it back under the hip.
  state.joint_position = {start.hip, -start.knee, 0.0, -start.hip, start.knee, 0.0};
  for (std::size_t i = 0; i < models::servo_count; ++i) {
    if (!model.has(i)) state.joint_position[i] = 0.0;
  }

  (void)kinematics(model, *data, state);
  line_up(model, *data, state);
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
