#pragma once

#include <array>
#include <btBulletDynamicsCommon.h>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyJointLimitConstraint.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <BulletDynamics/Featherstone/btMultiBodyPoint2Point.h>

#include "models/robot_model.hpp"
#include "simulators/simulator.hpp"

namespace touchdown::simulators {

/// The tyres of a robot in Bullet: their shapes, stiffness and damping.
class BulletTyres {
 public:
  BulletTyres(const models::RobotModel& robot, const SimulatorOptions& options);

  /// Registers child shape `child` of `collider` as a strip of `wheel`'s tyre.
  void add(btCollisionObject& collider, int child, std::size_t wheel);

  /// The wheel with a tyre that contains this child shape of a collision object, if any.
  std::optional<std::size_t> wheel_of(const btCollisionObject& object, int child) const;

  /// Removes contacts that do not count, after collision detection, if tyres are springs.
  void select_contacts(btDispatcher& dispatcher) const;

 private:
  struct Strip {
    const btCollisionObject* collider;
    int child;
    std::size_t wheel;
  };

  std::optional<std::size_t> strip_of(const btCollisionObject& object, int child) const;

  bool springs_;
  double stiffness_;  ///< of a strip, for Bullet (N/m)
  double damping_;    ///< of a strip, for Bullet (N·s/m)
  std::vector<Strip> strips_;
};

/// A Bullet world that removes tyre contacts that do not count.
class WorldWithTyres : public btMultiBodyDynamicsWorld {
 public:
  WorldWithTyres(const BulletTyres& tyres, btDispatcher& dispatcher,
                 btBroadphaseInterface& broadphase, btMultiBodyConstraintSolver& solver,
                 btCollisionConfiguration& configuration)
      : btMultiBodyDynamicsWorld(&dispatcher, &broadphase, &solver, &configuration),
        tyres_(tyres) {}

  void performDiscreteCollisionDetection() override;

 private:
  const BulletTyres& tyres_;
};

// Conversions between Bullet's and Eigen's vectors and quaternions.

inline btVector3 to_bullet(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
inline btQuaternion to_bullet(const Eigen::Quaterniond& q) { return {q.x(), q.y(), q.z(), q.w()}; }
inline Eigen::Vector3d to_eigen(const btVector3& v) { return {v.x(), v.y(), v.z()}; }
inline Eigen::Quaterniond to_eigen(const btQuaternion& q) { return {q.w(), q.x(), q.y(), q.z()}; }

/// A Bullet world built from the compiled MuJoCo model: the robot as one Featherstone
/// `btMultiBody`, the terrain as static bodies. Bullet's frames are the bodies' principal inertia
/// frames, with the base's frame at its centre of mass.
///
/// The terrain's friction coefficient counts, as in the model. Bullet multiplies both coefficients,
/// so that of the robot's colliders is 1.
class BulletWorld {
 public:
  /// Errors: `InputError` for shapes that Bullet cannot represent: ellipsoids and height fields.
  BulletWorld(const models::RobotModel& model, const SimulatorOptions& options);

  btMultiBodyDynamicsWorld& world() { return world_; }
  const btMultiBodyDynamicsWorld& world() const { return world_; }
  btMultiBody& robot() { return *robot_; }
  const btMultiBody& robot() const { return *robot_; }

  /// The link that a joint of the model moves. Its angle is zero in the reference pose of the
  /// model, that of the joint need not be.
  int link_of(int joint) const {
    return link_of_body_[static_cast<std::size_t>(body_of_joint_[joint])];
  }

  const BulletTyres& tyres() const { return tyres_; }

 private:
  void build_links(const models::RobotModel& model);
  void add_constraint(std::unique_ptr<btMultiBodyConstraint> constraint);
  /// Limits a link's angle, if the model limits its joint.
  template <typename Limit>
  void add_limit(const mjModel& mj, int joint);
  void add_colliders(const models::RobotModel& model);
  /// Closes the loops of closed legs.
  void add_loops(const models::RobotModel& model);
  void add_terrain(const models::RobotModel& model);
  /// The shape of a geom. It lives as long as the world.
  btCollisionShape* make_shape(const mjModel& mj, int geom);

  // In order of construction: the world refers to everything above it and is destroyed first.
  double edge_radius_;  ///< of boxes and cylinders (m)
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  btMultiBodyConstraintSolver solver_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> terrain_;
  std::unique_ptr<btMultiBody> robot_;
  std::vector<std::unique_ptr<btMultiBodyLinkCollider>> colliders_;
  std::vector<std::unique_ptr<btMultiBodyConstraint>> constraints_;
  std::vector<int> link_of_body_;
  const int* body_of_joint_ = nullptr;  ///< the model's
  BulletTyres tyres_;
  WorldWithTyres world_;

 public:
  ~BulletWorld();
  BulletWorld(const BulletWorld&) = delete;
  BulletWorld& operator=(const BulletWorld&) = delete;
};

class Rotors;

/// Bullet as a `Simulator`, in double precision. Every reset builds a new world: only a new world
/// gives the same bits again.
class BulletSimulator : public Simulator {
 public:
  BulletSimulator(const std::shared_ptr<const models::RobotModel>& model,
                  const SimulatorOptions& options);
  ~BulletSimulator() override;

  std::string_view name() const override { return "bullet"; }

 protected:
  /// The engine's own world; a reset replaces it.
  BulletWorld& bullet() { return *world_; }

  void place(const RobotState& start) override;
  void advance(const AppliedTorques& torques, std::span<const ExternalWrench> wrenches) override;
  void read(RobotState& state) const override;
  void read(ContactForces& forces) const override;

 private:
  /// The angle of a joint where its link's is zero (rad).
  double reference(int joint) const;
  /// The angle (rad) and velocity (rad/s) of a joint.
  void set_joint(int joint, double angle, double rate);
  double angle_of(int joint) const;
  double rate_of(int joint) const;

  std::unique_ptr<BulletWorld> world_;
  std::unique_ptr<Rotors> rotors_;
  Eigen::Vector3d base_com_;           ///< centre of mass of the base body in its frame (m)
  Eigen::Quaterniond base_principal_;  ///< its principal axes in its frame
};

}  // namespace touchdown::simulators
