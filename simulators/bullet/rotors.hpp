#pragma once

#include <array>
#include <vector>

#include "models/robot_model.hpp"
#include "simulators/bullet/world.hpp"

namespace touchdown::simulators {

/// Rotor inertia J seen through a gear, which resists the acceleration q̈ of its joint and nothing
/// else (MuJoCo's `armature`). Bullet's multi-body has none: there the rotor is part of the link
/// that the joint moves (world.cpp), so that contacts feel it too, and resists that link's whole
/// angular acceleration a·ẍ = q̈ + α, where α is the parent's about the joint's axis. The rest,
///
///     J·[a·(a·ẍ) − e·q̈]  =  J·α on the joint,  J·(q̈ + α) on the parent about the axis,
///
/// is taken back as a force, with the accelerations of the last few physics steps: what is faster
/// than that feels the rotor as a part of the link. It converges while the rotor is lighter than
/// what the joint hangs on.
class Rotors {
 public:
  Rotors(const models::RobotModel& model, const BulletWorld& world);

  /// Before a physics step of `period` (s).
  void take_back(btMultiBody& robot, double period);

 private:
  struct Rotor {
    int link;
    double inertia;
    double joint_velocity = 0.0;       ///< at the last step (rad/s)
    double parent_velocity = 0.0;      ///< about the joint's axis (rad/s)
    double joint_acceleration = 0.0;   ///< smoothed (rad/s²)
    double parent_acceleration = 0.0;  ///< likewise
  };

  std::vector<Rotor> rotors_;
  bool started_ = false;
};

}  // namespace touchdown::simulators
