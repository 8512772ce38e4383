#include "render/mcap/messages.hpp"

#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "render/film/primitives.hpp"

namespace touchdown::render {

namespace {

McapJson vector(const Eigen::Vector3d& v) { return {{"x", v.x()}, {"y", v.y()}, {"z", v.z()}}; }

McapJson quaternion(const Eigen::Quaterniond& q) {
  return {{"x", q.x()}, {"y", q.y()}, {"z", q.z()}, {"w", q.w()}};
}

McapJson pose(const Eigen::Vector3d& position, const Eigen::Quaterniond& orientation) {
  return {{"position", vector(position)}, {"orientation", quaternion(orientation)}};
}

McapJson colour(const Primitive& primitive) {
  const auto& [r, g, b, a] = primitive.colour;
  return {{"r", r}, {"g", g}, {"b", b}, {"a", a}};
}

McapJson sized(const Primitive& primitive) {
  return {{"pose", pose(primitive.position, primitive.orientation)},
          {"size", vector(primitive.size)},
          {"color", colour(primitive)}};
}

McapJson triangles(const mjModel& model, const Primitive& primitive) {
  McapJson points = McapJson::array();
  const std::span<const float> vertices = mesh_vertices(model, primitive.mesh);
  for (std::size_t i = 0; i + 2 < vertices.size(); i += 3) {
    points.push_back(vector(Eigen::Map<const Eigen::Vector3f>(vertices.data() + i).cast<double>()));
  }
  const std::span<const int> faces = mesh_triangles(model, primitive.mesh);
  return {{"pose", pose(primitive.position, primitive.orientation)},
          {"points", std::move(points)},
          {"color", colour(primitive)},
          {"colors", McapJson::array()},
          {"indices", std::vector<int>(faces.begin(), faces.end())}};
}

void add(McapJson& entity, const mjModel& model, const Primitive& primitive) {
  switch (primitive.shape) {
    case Shape::box:
      entity["cubes"].push_back(sized(primitive));
      break;
    case Shape::sphere:
      entity["spheres"].push_back(sized(primitive));
      break;
    case Shape::cylinder: {
      McapJson cylinder = sized(primitive);
      cylinder["bottom_scale"] = 1.0;
      cylinder["top_scale"] = 1.0;
      entity["cylinders"].push_back(std::move(cylinder));
      break;
    }
    case Shape::mesh:
      entity["triangles"].push_back(triangles(model, primitive));
      break;
  }
}

McapJson empty_entity(const mjModel& model, int body, std::uint64_t time) {
  McapJson entity{{"timestamp", mcap_time(time)},
                  {"frame_id", body_name(model, body)},
                  {"id", body_name(model, body)},
                  {"lifetime", mcap_time(0)},
                  {"frame_locked", true}};
  for (const char* const kind : {"metadata", "arrows", "cubes", "spheres", "cylinders", "lines",
                                 "triangles", "texts", "models"}) {
    entity[kind] = McapJson::array();
  }
  return entity;
}

}  // namespace

McapJson mcap_time(std::uint64_t time) {
  constexpr std::uint64_t second = 1'000'000'000;
  return {{"sec", time / second}, {"nsec", time % second}};
}

McapJson scene_update(const mjModel& model, std::uint64_t time) {
  McapJson entities = McapJson::array();
  for (int body = 0; body < model.nbody; ++body) {
    const std::vector<Primitive> primitives = primitives_of(model, body);
    if (primitives.empty()) continue;
    McapJson entity = empty_entity(model, body, time);
    for (const Primitive& primitive : primitives) add(entity, model, primitive);
    entities.push_back(std::move(entity));
  }
  return {{"deletions", McapJson::array()}, {"entities", std::move(entities)}};
}

McapJson frame_transforms(const mjModel& model, const mjData& data, std::uint64_t time) {
  McapJson transforms = McapJson::array();
  for (int body = 1; body < model.nbody; ++body) {
    transforms.push_back({{"timestamp", mcap_time(time)},
                          {"parent_frame_id", "world"},
                          {"child_frame_id", body_name(model, body)},
                          {"translation", vector(body_position(data, body))},
                          {"rotation", quaternion(body_orientation(data, body))}});
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
