#pragma once

#include <cstddef>

#include <Eigen/Core>
#include <mujoco/mujoco.h>

namespace touchdown::models {

// Robots of other sizes, made from a compiled one that keeps the naming contract: bodies, joints,
// what collides and what is drawn change alike, so that engines and pictures follow. After the last
// change, `recompute`.

/// Mass and inertia of every body: the robot keeps its shape.
void scale_mass(mjModel& mj, double factor);

/// The wheels about their axles, across them: tyres, rims, inertia. Width and mass stay.
void scale_wheels(mjModel& mj, double factor);

/// Both links of one leg (0 left, 1 right) along the line between their joints. Masses stay, for
/// most of a link's mass is its motors', which move with its ends; inertias are those of the same
/// matter stretched. What is round across the link stays round; meshes keep their size. Errors:
/// `InputError` if the joints are not the links' of one chain.
void scale_leg(mjModel& mj, std::size_t leg, double factor);

/// Where a body's centre of mass is in its frame (m); its inertia about it stays.
void shift_mass(mjModel& mj, int body, const Eigen::Vector3d& offset);

/// What MuJoCo derives from masses and sizes, without what pictures are drawn by.
void recompute(mjModel& mj);

}  // namespace touchdown::models
