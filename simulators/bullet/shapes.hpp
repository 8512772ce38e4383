#pragma once

#include <btBulletCollisionCommon.h>
#include <memory>
#include <vector>

#include <mujoco/mujoco.h>

namespace touchdown::simulators {

/// Owns collision shapes for as long as the world that uses them.
using BulletShapes = std::vector<std::unique_ptr<btCollisionShape>>;

/// The Bullet shape of a geom, in the geom's own frame; kept alive by `shapes`. Planes become
/// half-spaces, meshes their convex hulls, as in MuJoCo.
/// Errors: `InputError` for a geom type that has no counterpart (ellipsoid, height field).
btCollisionShape* make_shape(const mjModel& model, int geom, BulletShapes& shapes);

}  // namespace touchdown::simulators
