#pragma once

#include <cstddef>

#include <Eigen/Core>
#include <mujoco/mujoco.h>

#include "models/robot_model.hpp"

namespace touchdown::models {

// Functions that resize a compiled robot. Bodies, joints, collision
// geoms and visual geoms change alike, so that engines and renderer agree. Call `recompute` after
// the last change.

/// Scales the mass and the inertia of every body. The robot keeps its shape.
void scale_mass(mjModel& mj, double factor);

/// Scales the radius of both wheels: tyres, rims and inertia. Width and mass stay.
void scale_wheels(RobotModel& robot, double factor);

/// Scales both links of one leg (0 left, 1 right) along the line between their joints. Masses stay:
/// most of a link's mass is in its motors, which move with its ends. Inertias are those of the
/// stretched matter. Round cross-sections stay round; meshes keep their size. Errors: `InputError`
/// if the joints do not form one chain.
void scale_leg(RobotModel& robot, std::size_t leg, double factor);

/// Moves a body's centre of mass by `offset` in the body's frame (m). The inertia about it stays.
void shift_mass(mjModel& mj, int body, const Eigen::Vector3d& offset);

/// Recomputes what MuJoCo derives from masses and sizes, except the scene size used for rendering.
void recompute(mjModel& mj);

}  // namespace touchdown::models
