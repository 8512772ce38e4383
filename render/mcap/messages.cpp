#include "render/mcap/messages.hpp"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <fmt/format.h>

namespace touchdown::render {

namespace {

constexpr int groups_of_films = 3;        // MuJoCo's renderer draws groups 0 to 2
constexpr double plane_extent = 40.0;     // m: of a plane without a size
constexpr double plane_thickness = 1e-3;  // m

McapJson vector(const Eigen::Vector3d& v) { return {{"x", v.x()}, {"y", v.y()}, {"z", v.z()}}; }

McapJson quaternion(const Eigen::Quaterniond& q) {
  return {{"x", q.x()}, {"y", q.y()}, {"z", q.z()}, {"w", q.w()}};
}

McapJson pose(const Eigen::Vector3d& position, const Eigen::Quaterniond& orientation) {
  return {{"position", vector(position)}, {"orientation", quaternion(orientation)}};
}

Eigen::Vector3d vector_at(const mjtNum* numbers, int i) {
  return Eigen::Map<const Eigen::Vector3d>(numbers + 3 * i);
}

Eigen::Quaterniond quaternion_at(const mjtNum* numbers, int i) {
  const mjtNum* const q = numbers + 4 * i;
  return {q[0], q[1], q[2], q[3]};
}

const float* colour_of(const mjModel& model, int geom) {
  const int material = model.geom_matid[geom];
  return material >= 0 ? model.mat_rgba + 4 * material : model.geom_rgba + 4 * geom;
}

McapJson colour(const mjModel& model, int geom) {
  const float* const rgba = colour_of(model, geom);
  return {{"r", rgba[0]}, {"g", rgba[1]}, {"b", rgba[2]}, {"a", rgba[3]}};
}

bool is_drawn(const mjModel& model, int geom) {
  return model.geom_group[geom] < groups_of_films && colour_of(model, geom)[3] > 0.0F;
}

/// The name of a body as a frame.
std::string frame_of(const mjModel& model, int body) {
  if (body == 0) return "world";
  const char* const name = mj_id2name(&model, mjOBJ_BODY, body);
  return name == nullptr ? fmt::format("body_{}", body) : name;
}

/// The primitives of one entity.
class Entity {
 public:
  Entity(const mjModel& model, std::uint64_t time, int body)
      : model_(model),
        entity_{{"timestamp", mcap_time(time)},
                {"frame_id", frame_of(model, body)},
                {"id", frame_of(model, body)},
                {"lifetime", mcap_time(0)},
                {"frame_locked", true}} {
    for (const char* const kind : {"metadata", "arrows", "cubes", "spheres", "cylinders", "lines",
                                   "triangles", "texts", "models"}) {
      entity_[kind] = McapJson::array();
    }
  }

  void add(int geom) {
    const Eigen::Vector3d position = vector_at(model_.geom_pos, geom);
    const Eigen::Quaterniond orientation = quaternion_at(model_.geom_quat, geom);
    const Eigen::Vector3d size = vector_at(model_.geom_size, geom);
    switch (model_.geom_type[geom]) {
      case mjGEOM_PLANE: {
        const auto full = [](double half) { return half > 0.0 ? 2.0 * half : plane_extent; };
        const Eigen::Vector3d box(full(size.x()), full(size.y()), plane_thickness);
        const Eigen::Vector3d below(0.0, 0.0, -0.5 * plane_thickness);
        add_sized("cubes", geom, position + orientation * below, orientation, box);
        break;
      }
      case mjGEOM_BOX:
        add_sized("cubes", geom, position, orientation, 2.0 * size);
        break;
      case mjGEOM_SPHERE:
        add_sized("spheres", geom, position, orientation,
                  Eigen::Vector3d::Constant(2.0 * size.x()));
        break;
      case mjGEOM_ELLIPSOID:
        add_sized("spheres", geom, position, orientation, 2.0 * size);
        break;
      case mjGEOM_CAPSULE:
        for (const double end : {-size.y(), size.y()}) {
          add_sized("spheres", geom, position + orientation * Eigen::Vector3d(0.0, 0.0, end),
                    orientation, Eigen::Vector3d::Constant(2.0 * size.x()));
        }
        [[fallthrough]];
      case mjGEOM_CYLINDER:
        add_sized("cylinders", geom, position, orientation,
                  {2.0 * size.x(), 2.0 * size.x(), 2.0 * size.y()});
        entity_["cylinders"].back()["bottom_scale"] = 1.0;
        entity_["cylinders"].back()["top_scale"] = 1.0;
        break;
      case mjGEOM_MESH:
        add_mesh(geom, position, orientation);
        break;
      default:
        break;  // hfields: no robot or terrain has one
    }
  }

  McapJson take() && { return std::move(entity_); }

 private:
  void add_sized(const char* kind, int geom, const Eigen::Vector3d& position,
                 const Eigen::Quaterniond& orientation, const Eigen::Vector3d& size) {
    entity_[kind].push_back({{"pose", pose(position, orientation)},
                             {"size", vector(size)},
                             {"color", colour(model_, geom)}});
  }

  void add_mesh(int geom, const Eigen::Vector3d& position, const Eigen::Quaterniond& orientation) {
    const int mesh = model_.geom_dataid[geom];
    McapJson points = McapJson::array();
    const float* const vertices = model_.mesh_vert + 3 * model_.mesh_vertadr[mesh];
    for (int v = 0; v < model_.mesh_vertnum[mesh]; ++v) {
      points.push_back(vector(Eigen::Map<const Eigen::Vector3f>(vertices + 3 * v).cast<double>()));
    }
    const int* const faces = model_.mesh_face + 3 * model_.mesh_faceadr[mesh];
    McapJson indices = std::vector<int>(faces, faces + 3 * model_.mesh_facenum[mesh]);
    entity_["triangles"].push_back({{"pose", pose(position, orientation)},
                                    {"points", std::move(points)},
                                    {"color", colour(model_, geom)},
                                    {"colors", McapJson::array()},
                                    {"indices", std::move(indices)}});
  }

  const mjModel& model_;
  McapJson entity_;
};

}  // namespace

McapJson mcap_time(std::uint64_t time) {
  constexpr std::uint64_t second = 1'000'000'000;
  return {{"sec", time / second}, {"nsec", time % second}};
}

McapJson scene_update(const mjModel& model, std::uint64_t time) {
  McapJson entities = McapJson::array();
  for (int body = 0; body < model.nbody; ++body) {
    Entity entity(model, time, body);
    bool is_empty = true;
    for (int i = 0; i < model.body_geomnum[body]; ++i) {
      const int geom = model.body_geomadr[body] + i;
      if (!is_drawn(model, geom)) continue;
      entity.add(geom);
      is_empty = false;
    }
    if (!is_empty) entities.push_back(std::move(entity).take());
  }
  return {{"deletions", McapJson::array()}, {"entities", std::move(entities)}};
}

McapJson frame_transforms(const mjModel& model, const mjData& data, std::uint64_t time) {
  McapJson transforms = McapJson::array();
  for (int body = 1; body < model.nbody; ++body) {
    transforms.push_back({{"timestamp", mcap_time(time)},
                          {"parent_frame_id", "world"},
                          {"child_frame_id", frame_of(model, body)},
                          {"translation", vector(vector_at(data.xpos, body))},
                          {"rotation", quaternion(quaternion_at(data.xquat, body))}});
  }
  return {{"transforms", std::move(transforms)}};
}

McapJson log_message(const std::string& name, const std::string& message, int level,
                     std::uint64_t time) {
  return {{"timestamp", mcap_time(time)},
          {"level", level},
          {"message", message},
          {"name", name},
          {"file", ""},
          {"line", 0}};
}

}  // namespace touchdown::render
