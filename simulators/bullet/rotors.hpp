#pragma once

#include <array>
#include <vector>

#include "models/robot_model.hpp"
#include "simulators/bullet/world.hpp"

namespace touchdown::simulators {

/// Rotor inertia J reflected through a gear: it resists the acceleration q̈ of its joint only
/// (MuJoCo's `armature`). Bullet's multi-body has no such inertia. There the rotor is part of the
/// link that the joint moves (world.cpp), so it also acts on contacts. It then resists that link's
/// whole angular acceleration a·ẍ = q̈ + α, where α is the parent's about the joint's axis. The
/// excess,
///
///     J·[a·(a·ẍ) − e·q̈]  =  J·α on the joint,  J·(q̈ + α) on the parent about the axis,
///
/// is compensated by torques, with the accelerations of the last few physics steps. Faster motion
/// sees the rotor as part of the link. This converges while the rotor's inertia is smaller than
/// that of the joint's parent.
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

}  // namespace touchdown::simulators
