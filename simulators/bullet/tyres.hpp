#pragma once

#include <btBulletDynamicsCommon.h>
#include <cstddef>
#include <optional>
#include <vector>

#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>

#include "models/robot_model.hpp"
#include "simulators/options.hpp"

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

}  // namespace touchdown::simulators
