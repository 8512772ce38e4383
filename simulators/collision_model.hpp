#pragma once

#include "models/robot_model.hpp"

namespace touchdown::simulators {

/// A copy of the compiled model with only those geoms that can touch something, in the same order.
/// MuJoCo visits every geom of two bodies that may collide, drawn ones included: on the stairs they
/// cost more than all the rest of a step. Bodies, joints and their indices stay; geoms are
/// renumbered and keep their names. To simulate with, not to copy further. Errors: `Error` when
/// memory runs out.
models::MjModelPtr collision_model(const mjModel& model);

/// Whether a geom of the compiled model takes part in collisions at all.
bool collides(const mjModel& model, int geom);

}  // namespace touchdown::simulators
