#pragma once

#include "models/robot_model.hpp"

namespace touchdown::simulators {

/// A copy of the compiled model with only the geoms that can collide, in the same order. MuJoCo
/// visits every geom of two bodies that may collide, visual ones included: on stairs that takes
/// more time than the rest of a step. Bodies, joints and their indices stay. Geoms get new indices
/// and keep their names. Use it to simulate; do not copy it again. Errors: `Error` if memory runs
/// out.
models::MjModelPtr collision_model(const mjModel& model);

/// Whether a geom of the compiled model takes part in collisions.
bool collides(const mjModel& model, int geom);

}  // namespace touchdown::simulators
