#include "simulators/bullet/shapes.hpp"

#include <fmt/format.h>

#include "core/error.hpp"

namespace touchdown::simulators {

namespace {

std::unique_ptr<btCollisionShape> convex_hull(const mjModel& model, int mesh) {
  auto hull = std::make_unique<btConvexHullShape>();
  const float* vertices = model.mesh_vert + 3 * model.mesh_vertadr[mesh];
  for (int i = 0; i < model.mesh_vertnum[mesh]; ++i) {
    hull->addPoint(btVector3(vertices[3 * i], vertices[3 * i + 1], vertices[3 * i + 2]), false);
  }
  hull->recalcLocalAabb();
  return hull;
}

std::unique_ptr<btCollisionShape> shape_of(const mjModel& model, int geom) {
  const mjtNum* size = &model.geom_size[3 * geom];
  switch (model.geom_type[geom]) {
    case mjGEOM_PLANE:
      return std::make_unique<btStaticPlaneShape>(btVector3(0.0, 0.0, 1.0), 0.0);
    case mjGEOM_SPHERE:
      return std::make_unique<btSphereShape>(size[0]);
    case mjGEOM_CAPSULE:
      return std::make_unique<btCapsuleShapeZ>(size[0], 2.0 * size[1]);
    case mjGEOM_CYLINDER:
      return std::make_unique<btCylinderShapeZ>(btVector3(size[0], size[0], size[1]));
    case mjGEOM_BOX:
      return std::make_unique<btBoxShape>(btVector3(size[0], size[1], size[2]));
    case mjGEOM_MESH:
      return convex_hull(model, model.geom_dataid[geom]);
    default: {
      const char* name = mj_id2name(&model, mjOBJ_GEOM, geom);
      throw InputError(fmt::format(
          "geom '{}': Bullet has no counterpart of this shape (expected a plane, sphere, capsule, "
          "cylinder, box or mesh)",
          name != nullptr ? name : fmt::format("#{}", geom).c_str()));
    }
  }
}

}  // namespace

btCollisionShape* make_shape(const mjModel& model, int geom, BulletShapes& shapes) {
  return shapes.emplace_back(shape_of(model, geom)).get();
}

}  // namespace touchdown::simulators
