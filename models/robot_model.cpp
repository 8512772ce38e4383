#include "models/robot_model.hpp"

#include <algorithm>

namespace touchdown::models {

std::vector<int> RobotModel::others() const {
  std::vector<int> all = linked;
  for (const HeldJoint& one : held) all.push_back(one.joint);
  return all;
}

ClosedLegs closed_legs(const RobotModel& robot) {
  std::array<MotorLeg, wheel_count> legs;
  for (std::size_t leg = 0; leg < legs.size(); ++leg) {
    legs[leg].linkage = robot.closed_leg[leg]->linkage;
    const std::vector<int>& motors = legs[leg].linkage.motors;
    for (std::size_t i = 0; i < motors.size(); ++i) {
      if (motors[i] > 1) continue;  // cranks stay as in the file
      const std::size_t servo = 3 * leg + static_cast<std::size_t>(motors[i]);
      legs[leg].sign.at(i) = robot.is_reversed[servo] ? -1.0 : 1.0;
      legs[leg].zero.at(i) = robot.zero[servo];
    }
  }
  return ClosedLegs(std::move(legs));
}

std::string motor_name(const RobotModel& robot, std::size_t servo) {
  const int joint = robot.motor_joint[servo];
  const auto own = std::find(robot.joint.begin(), robot.joint.end(), joint);
  return own == robot.joint.end()
             ? mj_id2name(robot.mj.get(), mjOBJ_JOINT, joint)
             : robot.joint_name[static_cast<std::size_t>(own - robot.joint.begin())];
}

void write_pose(const RobotModel& robot, const Eigen::Vector3d& position,
                const Eigen::Quaterniond& orientation,
                const std::array<double, servo_count>& joint_position, mjtNum* qpos) {
  mjtNum* const base = qpos + robot.base_qpos();
  std::copy_n(position.data(), 3, base);
  set_quaternion(base + 3, 0, orientation);
  for (std::size_t i = 0; i < servo_count; ++i) {
    if (robot.has(i)) qpos[robot.qpos_address[i]] = joint_position[i];
  }
  for (std::size_t leg = 0; leg < wheel_count; ++leg) {
    // Measured legs only: those of a robot that is being compiled have no start yet.
    if (!robot.closed_leg[leg] || robot.closed_leg[leg]->linkage.start.size() == 0) continue;
    const Linkage& linkage = robot.closed_leg[leg]->linkage;
    const std::vector<int>& joint = robot.closed_leg[leg]->joint;
    LinkageVector q = linkage.start;
    const bool closes =
        move_virtual_leg(linkage, joint_position[3 * leg], joint_position[3 * leg + 1], q);
    for (std::size_t i = closes ? 0 : 2; i < joint.size(); ++i) {
      qpos[robot.mj->jnt_qposadr[joint[i]]] = q[static_cast<Eigen::Index>(i)];
    }
  }
}

void write_held(const RobotModel& robot, std::span<const double> position, mjtNum* qpos) {
  for (std::size_t i = 0; i < robot.held.size(); ++i) {
    const HeldJoint& held = robot.held[i];
    qpos[held.qpos_address] = i < position.size() ? position[i] : held.reference;
  }
}

MjDataPtr at_pose(const RobotModel& robot, const Eigen::Quaterniond& orientation,
                  const std::array<double, servo_count>& joint_position) {
  MjDataPtr data = make_data(*robot.mj);
  write_pose(robot, Eigen::Vector3d::Zero(), orientation, joint_position, data->qpos);
  mj_kinematics(robot.mj.get(), data.get());
  mj_comPos(robot.mj.get(), data.get());
  mj_crb(robot.mj.get(), data.get());
  return data;
}

MjDataPtr at_zero(const RobotModel& robot) {
  return at_pose(robot, Eigen::Quaterniond::Identity(), {});
}

MjDataPtr at_reference(const RobotModel& robot) {
  std::array<double, servo_count> position = {};
  for (std::size_t i = 0; i < servo_count; ++i) {
    if (robot.has(i)) position[i] = robot.reference(i);
  }
  return at_pose(robot, Eigen::Quaterniond::Identity(), position);
}

}  // namespace touchdown::models
