#pragma once

#include <btBulletDynamicsCommon.h>
#include <cstddef>
#include <optional>
#include <vector>

#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>

#include "models/robot_model.hpp"
#include "simulators/options.hpp"

namespace touchdown::simulators {

/// The tyres of a robot in Bullet: which shapes they are, and how they press.
class BulletTyres {
 public:
  BulletTyres(const models::RobotModel& robot, const SimulatorOptions& options);

  /// Child shape `child` of what `collider` is made of is a strip of `wheel`'s tyre.
  void add(btCollisionObject& collider, int child, std::size_t wheel);

  /// Which wheel's tyre a child shape of a collision object is of, if any.
  std::optional<std::size_t> wheel_of(const btCollisionObject& object, int child) const;

  /// After collision detection, for tyres that are springs: removes contacts that do not count.
  void choose_contacts(btDispatcher& dispatcher) const;

 private:
  struct Strip {
    const btCollisionObject* collider;
    int child;
    std::size_t wheel;
  };

  std::optional<std::size_t> strip_of(const btCollisionObject& object, int child) const;

  bool springs_;
  double stiffness_;  ///< of a strip, as Bullet wants it (N/m)
  double damping_;    ///< likewise (N·s/m)
  std::vector<Strip> strips_;
};

/// A world in which tyres choose their contacts.
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

}  // namespace touchdown::simulators
