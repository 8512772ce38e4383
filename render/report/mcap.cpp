#include "render/report/mcap.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include "logs/log/mcap.hpp"
#include "models/mjcf/types.hpp"
#include "render/film/primitives.hpp"
#include "render/film/scene_view.hpp"
#include "scenarios/scenario.hpp"
#include "scoring/labels.hpp"

namespace touchdown::render {

namespace {

/// A message of a Foxglove schema, as JSON.
using McapJson = nlohmann::ordered_json;

/// A time (ns) as seconds and nanoseconds.
McapJson mcap_time(std::uint64_t time) {
  constexpr std::uint64_t second = 1'000'000'000;
  return {{"sec", time / second}, {"nsec", time % second}};
}

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
  const TriangleMesh mesh = mesh_of(model, primitive.mesh);
  McapJson points = McapJson::array();
  for (const Eigen::Vector3d& vertex : mesh.vertices) points.push_back(vector(vertex));
  return {{"pose", pose(primitive.position, primitive.orientation)},
          {"points", std::move(points)},
          {"color", colour(primitive)},
          {"colors", McapJson::array()},
          {"indices", mesh.indices}};
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

/// foxglove.SceneUpdate: everything that films draw of the robot and its terrain. Each body is an
/// entity in a frame of its own, named as the body; the terrain is in the frame "world". Meshes
/// become triangles, a plane a thin box, a capsule a cylinder with two spheres.
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

/// foxglove.FrameTransforms: the pose of each body in the frame "world". `data` holds the poses.
McapJson frame_transforms(const mjModel& model, const mjData& data, std::uint64_t time) {
  McapJson transforms = McapJson::array();
  for (int body = 1; body < model.nbody; ++body) {
    transforms.push_back({{"timestamp", mcap_time(time)},
                          {"parent_frame_id", "world"},
                          {"child_frame_id", body_name(model, body)},
                          {"translation", vector(models::vector_at(data.xpos, body))},
                          {"rotation", quaternion(models::quaternion_at(data.xquat, body))}});
  }
  return {{"transforms", std::move(transforms)}};
}

/// foxglove.Log: an event. `level`: 2 for information, 3 for a warning.
McapJson log_message(const std::string& name, const std::string& message, int level,
                     std::uint64_t time) {
  return {{"timestamp", mcap_time(time)},
          {"level", level},
          {"message", message},
          {"name", name},
          {"file", ""},
          {"line", 0}};
}

constexpr double transform_period = 0.02;  // s
constexpr int information = 2, warning = 3;

struct LogEvent {
  std::string name, message;
  int level;
};

/// True takeoffs and landings of both wheels by row, and how the run ended.
std::multimap<std::size_t, LogEvent> events_of(const logs::Recording& recording) {
  std::multimap<std::size_t, LogEvent> events;
  if (recording.truth.size() < recording.steps()) return events;
  const auto contact = scoring::contact_labels(recording, {});
  for (std::size_t wheel = 0; wheel < contact.size(); ++wheel) {
    const char* const side = wheel == 0 ? "left" : "right";
    for (const scoring::Flight& flight : scoring::flights(contact[wheel])) {
      if (flight.takeoff > 0) {
        events.insert({flight.takeoff,
                       {"ground truth", fmt::format("{} wheel takes off", side), information}});
      }
      if (flight.landing < recording.steps()) {
        const double time =
            recording.period() * static_cast<double>(flight.landing - flight.takeoff);
        events.insert(
            {flight.landing,
             {"ground truth", fmt::format("{} wheel lands after {:.0f} ms", side, 1e3 * time),
              information}});
      }
    }
  }
  if (recording.info.outcome) {
    const bool is_finished = *recording.info.outcome == logs::Outcome::finished;
    events.insert({recording.steps() - 1,
                   {"run", scenarios::outcome_text(*recording.info.outcome),
                    is_finished ? information : warning}});
  }
  return events;
}

}  // namespace

std::uint64_t write_mcap_with_scene(logs::LogReader& reader, std::ostream& stream,
                                    const models::RobotModel& robot,
                                    const logs::Recording& recording) {
  const Poses poses(robot, recording);
  const models::MjDataPtr data(mj_makeData(robot.mj.get()));
  const auto events = events_of(recording);
  const auto every =
      static_cast<std::size_t>(std::max(1L, std::lround(transform_period / recording.period())));
  std::uint16_t of_transforms = 0;
  std::uint16_t of_events = 0;
  return logs::write_mcap(
      reader, stream, [&](logs::McapWriter& writer, std::uint64_t row, std::uint64_t time) {
        if (row >= poses.count()) return;
        if (row % every == 0) {
          poses.apply(row, *data);
          const std::string transforms = frame_transforms(*robot.mj, *data, time).dump();
          if (row == 0) {
            const std::string scene = scene_update(*robot.mj, time).dump();
            writer.write(writer.add_topic(mcap_scene_topic, "foxglove.SceneUpdate",
                                          logs::json_schema_of(scene)),
                         time, scene);
            of_transforms = writer.add_topic(mcap_transforms_topic, "foxglove.FrameTransforms",
                                             logs::json_schema_of(transforms));
            of_events = writer.add_topic(
                mcap_events_topic, "foxglove.Log",
                logs::json_schema_of(log_message("", "", information, time).dump()));
          }
          writer.write(of_transforms, time, transforms);
        }
        const auto [begin, end] = events.equal_range(row);
        for (auto event = begin; event != end; ++event) {
          const auto& [name, message, level] = event->second;
          writer.write(of_events, time, log_message(name, message, level, time).dump());
        }
      });
}

}  // namespace touchdown::render
