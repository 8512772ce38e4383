#include "render/film/primitives.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "models/mjcf/types.hpp"

namespace touchdown::render {

namespace {

constexpr int groups_of_films = 3;        // MuJoCo's renderer draws groups 0 to 2
constexpr double plane_extent = 40.0;     // m: of a plane without a size
constexpr double plane_thickness = 1e-3;  // m

const float* colour_of(const mjModel& model, int geom) {
  const int material = model.geom_matid[geom];
  return material >= 0 ? model.mat_rgba + 4 * material : model.geom_rgba + 4 * geom;
}

bool is_drawn(const mjModel& model, int geom) {
  return model.geom_group[geom] < groups_of_films && colour_of(model, geom)[3] > 0.0F;
}

void add_geom(const mjModel& model, int geom, std::vector<Primitive>& primitives) {
  Primitive primitive{.position = models::vector_at(model.geom_pos, geom),
                      .orientation = models::quaternion_at(model.geom_quat, geom)};
  std::copy_n(colour_of(model, geom), 4, primitive.colour.begin());
  const Eigen::Vector3d centre = primitive.position;
  const Eigen::Vector3d size = models::vector_at(model.geom_size, geom);
  const auto add = [&](Shape shape, const Eigen::Vector3d& full, double along_z = 0.0) {
    primitive.shape = shape;
    primitive.size = full;
    primitive.position = centre;
    if (along_z != 0.0) {
      primitive.position += primitive.orientation * Eigen::Vector3d(0.0, 0.0, along_z);
    }
    primitives.push_back(primitive);
  };
  switch (model.geom_type[geom]) {
    case mjGEOM_PLANE: {
      const auto full = [](double half) { return half > 0.0 ? 2.0 * half : plane_extent; };
      add(Shape::box, {full(size.x()), full(size.y()), plane_thickness}, -0.5 * plane_thickness);
      break;
    }
    case mjGEOM_BOX:
      add(Shape::box, 2.0 * size);
      break;
    case mjGEOM_SPHERE:
      add(Shape::sphere, Eigen::Vector3d::Constant(2.0 * size.x()));
      break;
    case mjGEOM_ELLIPSOID:
      add(Shape::sphere, 2.0 * size);
      break;
    case mjGEOM_CAPSULE:
      for (const double end : {-size.y(), size.y()}) {
        add(Shape::sphere, Eigen::Vector3d::Constant(2.0 * size.x()), end);
      }
      [[fallthrough]];
    case mjGEOM_CYLINDER:
      add(Shape::cylinder, {2.0 * size.x(), 2.0 * size.x(), 2.0 * size.y()});
      break;
    case mjGEOM_MESH:
      primitive.mesh = model.geom_dataid[geom];
      add(Shape::mesh, Eigen::Vector3d::Ones());
      break;
    default:
      break;  // hfields: no robot or terrain has one
  }
}

}  // namespace

std::vector<Primitive> primitives_of(const mjModel& model, int body) {
  std::vector<Primitive> primitives;
  for (int i = 0; i < model.body_geomnum[body]; ++i) {
    const int geom = model.body_geomadr[body] + i;
    if (is_drawn(model, geom)) add_geom(model, geom, primitives);
  }
  return primitives;
}

std::string body_name(const mjModel& model, int body) {
  if (body == 0) return "world";
  const char* const name = mj_id2name(&model, mjOBJ_BODY, body);
  return name == nullptr ? fmt::format("body_{}", body) : name;
}

TriangleMesh mesh_of(const mjModel& model, int mesh) {
  TriangleMesh result;
  const float* vertex = model.mesh_vert + 3 * model.mesh_vertadr[mesh];
  for (int i = 0; i < model.mesh_vertnum[mesh]; ++i, vertex += 3) {
    result.vertices.emplace_back(vertex[0], vertex[1], vertex[2]);
  }
  const int* const indices = model.mesh_face + 3 * model.mesh_faceadr[mesh];
  result.indices.assign(indices, indices + 3 * model.mesh_facenum[mesh]);
  return result;
}

}  // namespace touchdown::render
