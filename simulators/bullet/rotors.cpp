#include "simulators/bullet/rotors.hpp"

namespace touchdown::simulators {

namespace {

/// Weight of the newest acceleration. With 1, stiff standing robots oscillate; 0.5 suffices.
constexpr double smoothing = 0.25;

btVector3 axis_in_world(const btMultiBody& robot, int link) {
  return robot.localDirToWorld(link, robot.getLink(link).getAxisTop(0));
}

btVector3 angular_velocity(const btMultiBody& robot, int link) {
  btVector3 velocity = robot.getBaseOmega();
  for (; link >= 0; link = robot.getParent(link)) {
    if (robot.getLink(link).m_dofCount == 0) continue;
    velocity += axis_in_world(robot, link) * robot.getJointVel(link);
  }
  return velocity;
}

}  // namespace

Rotors::Rotors(const models::RobotModel& model, const BulletWorld& world) {
  const auto add = [&](int dof, int link) {
    const double inertia = model.mj->dof_armature[dof];
    if (inertia > 0.0) rotors_.push_back({link, inertia});
  };
  for (std::size_t servo = 0; servo < models::servo_count; ++servo) {
    if (model.has(servo)) add(model.dof_address[servo], world.link_of(servo));
  }
  for (std::size_t i = 0; i < model.held.size(); ++i) {
    add(model.held[i].dof_address, world.link_of_held(i));
  }
}

void Rotors::compensate(btMultiBody& robot, double period) {
  for (Rotor& rotor : rotors_) {
    const int above = robot.getParent(rotor.link);
    const btVector3 axis = axis_in_world(robot, rotor.link);
    const double joint_velocity = robot.getJointVel(rotor.link);
    const double parent_velocity = angular_velocity(robot, above).dot(axis);
    if (started_) {
      const double joint = (joint_velocity - rotor.joint_velocity) / period;
      const double parent = (parent_velocity - rotor.parent_velocity) / period;
      rotor.joint_acceleration += smoothing * (joint - rotor.joint_acceleration);
      rotor.parent_acceleration += smoothing * (parent - rotor.parent_acceleration);
      robot.addJointTorque(rotor.link, rotor.inertia * rotor.parent_acceleration);
      const btVector3 torque =
          rotor.inertia * (rotor.joint_acceleration + rotor.parent_acceleration) * axis;
      if (above < 0) {
        robot.addBaseTorque(torque);
      } else {
        robot.addLinkTorque(above, torque);
      }
    }
    rotor.joint_velocity = joint_velocity;
    rotor.parent_velocity = parent_velocity;
  }
  started_ = true;
}

}  // namespace touchdown::simulators
