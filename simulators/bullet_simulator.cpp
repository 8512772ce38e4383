#include <vector>

#include "models/simulated_joints.hpp"
#include "simulators/bullet.hpp"
#include "simulators/engines.hpp"

namespace touchdown::simulators {

namespace {

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

/// Rotor inertia J reflected through a gear: it resists the acceleration q̈ of its joint only
/// (MuJoCo's `armature`). Bullet's multi-body has no such inertia. There the rotor is part of the
/// link that the joint moves (bullet_world.cpp), so it also acts on contacts. It then resists that
/// link's whole angular acceleration a·ẍ = q̈ + α, where α is the parent's about the joint's axis.
/// The excess,
///
///     J·[a·(a·ẍ) − e·q̈]  =  J·α on the joint,  J·(q̈ + α) on the parent about the axis,
///
/// is compensated by torques, with the accelerations of the last few physics steps. Faster motion
/// sees the rotor as part of the link. This converges while the rotor's inertia is smaller than
/// that of the joint's parent. Derived gains allow for it (policies/servo_stability.cpp).
class Rotors {
 public:
  Rotors(const models::RobotModel& model, const BulletWorld& world);

  /// Adds the compensating torques, before a physics step of `period` (s).
  void compensate(btMultiBody& robot, double period);

 private:
  struct Rotor {
    int link;
    double inertia;
    double joint_velocity = 0.0;       ///< at the last step (rad/s)
    double parent_velocity = 0.0;      ///< about the joint's axis (rad/s)
    double joint_acceleration = 0.0;   ///< smoothed (rad/s²)
    double parent_acceleration = 0.0;  ///< smoothed, about the joint's axis (rad/s²)
  };

  std::vector<Rotor> rotors_;
  bool started_ = false;
};

Rotors::Rotors(const models::RobotModel& model, const BulletWorld& world) {
  const auto add = [&](int joint) {
    const double inertia = model.mj->dof_armature[model.mj->jnt_dofadr[joint]];
    if (inertia > 0.0) rotors_.push_back({world.link_of(joint), inertia});
  };
  for (const int joint : model.joint) {
    if (joint >= 0) add(joint);
  }
  for (const int joint : model.others()) add(joint);
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
      rotor.joint_acceleration += models::rotor_smoothing * (joint - rotor.joint_acceleration);
      rotor.parent_acceleration += models::rotor_smoothing * (parent - rotor.parent_acceleration);
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

BulletSimulator::BulletSimulator(const std::shared_ptr<const models::RobotModel>& model,
                                 const SimulatorOptions& options)
    : Simulator(model, options),
      base_com_(models::vector_at(model->mj->body_ipos, model->base_body)),
      base_principal_(models::quaternion_at(model->mj->body_iquat, model->base_body)) {
  place({});
}

BulletSimulator::~BulletSimulator() = default;

std::unique_ptr<Simulator> make_bullet(const std::shared_ptr<const models::RobotModel>& model,
                                       const SimulatorOptions& options) {
  return std::make_unique<BulletSimulator>(model, options);
}

double BulletSimulator::reference(int joint) const {
  return model().mj->qpos0[model().mj->jnt_qposadr[joint]];
}

void BulletSimulator::set_joint(int joint, double angle, double rate) {
  world_->robot().setJointPos(world_->link_of(joint), angle - reference(joint));
  world_->robot().setJointVel(world_->link_of(joint), rate);
}

double BulletSimulator::angle_of(int joint) const {
  const double angle = world_->robot().getJointPos(world_->link_of(joint));
  return reference(joint) == 0.0 ? angle : angle + reference(joint);  // zeros keep their sign
}

double BulletSimulator::rate_of(int joint) const {
  return world_->robot().getJointVel(world_->link_of(joint));
}

void BulletSimulator::place(const RobotState& start) {
  world_ = std::make_unique<BulletWorld>(model(), options());
  rotors_ = std::make_unique<Rotors>(model(), *world_);
  btMultiBody& robot = world_->robot();
  const Eigen::Vector3d com_offset = start.orientation * base_com_;
  robot.setBasePos(to_bullet(start.position + com_offset));
  robot.setWorldToBaseRot(to_bullet((start.orientation * base_principal_).conjugate()));
  robot.setBaseVel(to_bullet(start.linear_velocity + start.angular_velocity.cross(com_offset)));
  robot.setBaseOmega(to_bullet(start.angular_velocity));
  for (std::size_t i = 0; i < models::servo_count; ++i) {
    if (!model().has(i)) continue;
    set_joint(model().joint[i], start.joint_position[i], start.joint_velocity[i]);
  }
  for (std::size_t i = 0; i < start.other_position.size(); ++i) {
    set_joint(others()[i], start.other_position[i], start.other_velocity[i]);
  }
  btAlignedObjectArray<btQuaternion> rotations;
  btAlignedObjectArray<btVector3> origins;
  robot.forwardKinematics(rotations, origins);
  robot.updateCollisionObjectWorldTransforms(rotations, origins);
}

void BulletSimulator::advance(const AppliedTorques& torques,
                              std::span<const ExternalWrench> wrenches) {
  btMultiBody& robot = world_->robot();
  for (std::size_t i = 0; i < models::servo_count; ++i) {
    const int joint = model().motor_joint[i];
    if (joint >= 0) robot.addJointTorque(world_->link_of(joint), torques.servo[i]);
  }
  for (std::size_t i = 0; i < torques.held.size(); ++i) {
    robot.addJointTorque(world_->link_of(model().held[i].joint), torques.held[i]);
  }
  for (const ExternalWrench& wrench : wrenches) {
    robot.addBaseForce(to_bullet(wrench.force));
    robot.addBaseTorque(to_bullet(torque_about(base_com_, wrench, state())));
  }
  rotors_->compensate(robot, physics_period());
  // Zero sub-steps: one step of exactly this length.
  world_->world().stepSimulation(physics_period(), 0);
}

void BulletSimulator::read(RobotState& state) const {
  const btMultiBody& robot = world_->robot();
  state.orientation = to_eigen(robot.getWorldToBaseRot()).conjugate() * base_principal_.conjugate();
  const Eigen::Vector3d com_offset = state.orientation * base_com_;
  state.angular_velocity = to_eigen(robot.getBaseOmega());
  state.position = to_eigen(robot.getBasePos()) - com_offset;
  state.linear_velocity = to_eigen(robot.getBaseVel()) - state.angular_velocity.cross(com_offset);
  for (std::size_t i = 0; i < models::servo_count; ++i) {
    if (!model().has(i)) continue;
    state.joint_position[i] = angle_of(model().joint[i]);
    state.joint_velocity[i] = rate_of(model().joint[i]);
  }
  state.other_position.clear();
  state.other_velocity.clear();
  for (const int joint : others()) {
    state.other_position.push_back(angle_of(joint));
    state.other_velocity.push_back(rate_of(joint));
  }
}

void BulletSimulator::read(ContactForces& forces) const {
  forces = {};
  const btDispatcher& dispatcher = *world_->world().getDispatcher();
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold =
        *const_cast<btDispatcher&>(dispatcher).getManifoldByIndexInternal(i);
    const bool robot_is_first =
        manifold.getBody0()->getInternalType() == btCollisionObject::CO_FEATHERSTONE_LINK;
    const btCollisionObject& robot_part =
        robot_is_first ? *manifold.getBody0() : *manifold.getBody1();
    for (int p = 0; p < manifold.getNumContacts(); ++p) {
      const btManifoldPoint& point = manifold.getContactPoint(p);
      // The manifold keeps contact points of separated shapes: only an impulse is contact.
      if (point.getAppliedImpulse() <= 0.0) continue;
      const auto wheel =
          world_->tyres().wheel_of(robot_part, robot_is_first ? point.m_index0 : point.m_index1);
      if (!wheel) {
        forces.body_touches_terrain = true;
      } else {
        forces.wheel_normal_force[*wheel] += point.getAppliedImpulse() / physics_period();
      }
    }
  }
}

}  // namespace touchdown::simulators
