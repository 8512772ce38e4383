#include "render/film/pose.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace touchdown::render {
namespace {

/// The wheels' mean path since the first row, without slip (m).
std::vector<Eigen::Vector3d> odometry(const models::RobotModel& robot,
                                      const recordings::Recording& recording) {
  std::vector<Eigen::Vector3d> path(recording.steps(), Eigen::Vector3d::Zero());
  const auto forward = [](const models::Observation& observation) {
    return 0.5 * (observation.servo[models::index(models::Servo::left_wheel)].position -
                  observation.servo[models::index(models::Servo::right_wheel)].position);
  };
  for (std::size_t k = 1; k < path.size(); ++k) {
    const models::Observation& now = recording.observation[k];
    const double step = robot.wheel_radius * (forward(now) - forward(recording.observation[k - 1]));
    path[k] = path[k - 1] + step * Eigen::Vector3d(std::cos(now.yaw), std::sin(now.yaw), 0.0);
    if (!path[k].allFinite()) path[k] = path[k - 1];
  }
  return path;
}

Eigen::Quaterniond finite_or_upright(const Eigen::Quaterniond& orientation) {
  const bool good = orientation.coeffs().allFinite() && orientation.norm() > 0.5;
  return good ? orientation.normalized() : Eigen::Quaterniond::Identity();
}

std::vector<double> held_positions(const models::GroundTruth& truth) {
  std::vector<double> positions;
  for (const models::ServoReading& held : truth.held) positions.push_back(held.position);
  return positions;
}

}  // namespace

Poses::Poses(const models::RobotModel& robot, const recordings::Recording& recording)
    : robot_(robot), recording_(recording) {
  if (recording.steps() == 0) throw InputError("the recording is empty: there is nothing to draw");
  if (recording.truth.size() < recording.steps()) {
    base_ = odometry(robot, recording);
    return;
  }
  Eigen::Vector3d last = Eigen::Vector3d::Zero();
  base_.reserve(recording.steps());
  for (std::size_t k = 0; k < recording.steps(); ++k) {
    const Eigen::Vector3d& position = recording.truth[k].base_position;
    // A diverged run ends in numbers that cannot be drawn.
    if (position.allFinite() && position.norm() < 1e4) last = position;
    base_.push_back(last);
  }
}

void Poses::apply(std::size_t row, mjData& data) const {
  const mjModel& model = *robot_.mj;
  const models::Observation& observation = recording_.observation[row];
  const bool simulated = recording_.truth.size() >= recording_.steps();
  const Eigen::Quaterniond orientation = finite_or_upright(
      simulated ? recording_.truth[row].base_orientation
                : Eigen::AngleAxisd(observation.yaw, Eigen::Vector3d::UnitZ()) *
                      Eigen::AngleAxisd(observation.pitch, Eigen::Vector3d::UnitY()));
  std::array<double, models::servo_count> joints;
  for (std::size_t i = 0; i < models::servo_count; ++i) {
    const double angle = observation.servo[i].position;
    joints[i] = std::isfinite(angle) ? angle : 0.0;
  }
  models::write_pose(robot_, base_[row], orientation, joints, data.qpos);
  const std::vector<double> held =
      simulated ? held_positions(recording_.truth[row]) : std::vector<double>();
  models::write_held(robot_, held, data.qpos);
  if (!simulated) {
    mj_kinematics(&model, &data);
    double lowest = data.geom_xpos[3 * robot_.tyre_geom[0] + 2];
    for (const int geom : robot_.tyre_geom) {
      lowest = std::min(lowest, data.geom_xpos[3 * geom + 2]);
    }
    data.qpos[robot_.base_qpos() + 2] += robot_.wheel_radius - lowest;
  }
  update_geoms(model, data);
}

void update_geoms(const mjModel& model, mjData& data) {
  mj_kinematics(&model, &data);
  mj_comPos(&model, &data);
  mj_camlight(&model, &data);
}

std::vector<Eigen::Vector3d> smoothed(std::vector<Eigen::Vector3d> values, double period,
                                      double time_constant) {
  const double gain = 1.0 - std::exp(-period / time_constant);
  for (std::size_t k = 1; k < values.size(); ++k) {
    values[k] = values[k - 1] + gain * (values[k] - values[k - 1]);
  }
  for (std::size_t k = values.size(); k-- > 1;) {
    values[k - 1] = values[k] + gain * (values[k - 1] - values[k]);
  }
  return values;
}

}  // namespace touchdown::render
