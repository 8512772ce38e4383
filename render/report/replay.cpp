#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>
#include <fmt/format.h>

#include "models/mjcf/types.hpp"
#include "render/film/primitives.hpp"
#include "render/film/scene_view.hpp"
#include "render/report/html.hpp"
#include "render/report/sections.hpp"

namespace touchdown::render {

namespace {

/// The mesh with its vertices at the middles of a grid's cells.
TriangleMesh on_grid(const TriangleMesh& mesh, const Eigen::Vector3d& corner, double cell) {
  TriangleMesh result;
  std::map<std::array<long, 3>, int> index_of;
  std::vector<int> moved;
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    const Eigen::Vector3d at = ((vertex - corner) / cell).array().floor();
    const std::array<long, 3> key = {std::lround(at.x()), std::lround(at.y()), std::lround(at.z())};
    const auto [found, is_new] =
        index_of.try_emplace(key, static_cast<int>(result.vertices.size()));
    if (is_new) {
      result.vertices.emplace_back(corner + cell * (at + Eigen::Vector3d::Constant(0.5)));
    }
    moved.push_back(found->second);
  }
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    std::array<int, 3> triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      triangle[k] = moved[static_cast<std::size_t>(mesh.indices[i + k])];
    }
    const auto [a, b, c] = triangle;
    if (a == b || b == c || c == a) continue;
    result.indices.insert(result.indices.end(), triangle.begin(), triangle.end());
  }
  return result;
}

/// Numbers of 8 bits, or of 32 bits in little-endian order, as base64.
template <typename Number>
std::string packed(const std::vector<Number>& values) {
  return base64(std::string_view(reinterpret_cast<const char*>(values.data()),
                                 sizeof(Number) * values.size()));
}

/// Meshes of a scene have together about this many triangles at most.
constexpr std::size_t most_mesh_triangles = 40'000;

double rounded(double value) { return std::round(value * 1e5) / 1e5; }

Json numbers(const Eigen::Vector3d& v) { return {rounded(v.x()), rounded(v.y()), rounded(v.z())}; }

Json mesh_json(const mjModel& model, int mesh, std::size_t most_triangles) {
  const TriangleMesh shown = reduced(mesh_of(model, mesh), most_triangles);
  std::vector<float> numbers;
  for (const Eigen::Vector3d& vertex : shown.vertices) {
    for (const double number : vertex) numbers.push_back(static_cast<float>(number));
  }
  return {{"vertices", packed(numbers)}, {"triangles", shown.indices}};
}

/// The bodies that have something to draw. The terrain is always the first.
std::vector<int> drawn_bodies(const mjModel& model) {
  std::vector<int> bodies = {0};
  for (int body = 1; body < model.nbody; ++body) {
    if (!primitives_of(model, body).empty()) bodies.push_back(body);
  }
  return bodies;
}

Json scene_json(const models::RobotModel& robot) {
  const mjModel& model = *robot.mj;
  Json bodies = Json::array();
  Json meshes = Json::array();
  const std::size_t most_triangles =
      most_mesh_triangles / static_cast<std::size_t>(std::max(1, static_cast<int>(model.nmesh)));
  for (const int body : drawn_bodies(model)) {
    Json shapes = Json::array();
    for (const Primitive& primitive : primitives_of(model, body)) {
      const Eigen::Quaterniond& q = primitive.orientation;
      Json shape = {static_cast<int>(primitive.shape)};
      for (const double number : primitive.position) shape.push_back(rounded(number));
      for (const double number : {q.w(), q.x(), q.y(), q.z()}) shape.push_back(rounded(number));
      for (const double number : primitive.size) shape.push_back(rounded(number));
      for (std::size_t i = 0; i < 3; ++i) {
        shape.push_back(std::lround(255.0F * primitive.colour[i]));
      }
      if (primitive.mesh >= 0) {
        shape.push_back(meshes.size());
        meshes.push_back(mesh_json(model, primitive.mesh, most_triangles));
      }
      shapes.push_back(std::move(shape));
    }
    bodies.push_back(std::move(shapes));
  }
  return {{"bodies", std::move(bodies)}, {"meshes", std::move(meshes)}};
}

/// The rows of the recording at `rate` per second.
std::vector<std::size_t> rows_at(const logs::Recording& recording, double rate) {
  const double last = recording.period() * static_cast<double>(recording.steps() - 1);
  const auto count = static_cast<std::size_t>(std::min(last, longest_replay) * rate + 1e-9) + 1;
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < count; ++i) {
    const double row = std::round(static_cast<double>(i) / rate / recording.period());
    rows.push_back(std::min(static_cast<std::size_t>(row), recording.steps() - 1));
  }
  return rows;
}

void add_poses(const VideoSource& source, Json& run) {
  const models::RobotModel& robot = source.robot;
  const Poses poses(robot, source.recording);
  const models::MjDataPtr data(mj_makeData(robot.mj.get()));
  const std::vector<int> bodies = drawn_bodies(*robot.mj);
  const std::vector<std::size_t> rows = rows_at(source.recording, replay_pose_rate);
  std::vector<float> positions, orientations;
  const auto add = [](std::vector<float>& all, const auto& numbers) {
    for (const double number : numbers) all.push_back(static_cast<float>(number));
  };
  for (const std::size_t row : rows) {
    poses.apply(row, *data);
    for (std::size_t i = 1; i < bodies.size(); ++i) {
      add(positions, models::vector_at(data->xpos, bodies[i]));
      const Eigen::Quaterniond q = models::quaternion_at(data->xquat, bodies[i]);
      add(orientations, std::array{q.w(), q.x(), q.y(), q.z()});
    }
  }
  const auto place_of = [&](int body) { return std::ranges::find(bodies, body) - bodies.begin(); };
  run["pose_rate"] = replay_pose_rate;
  run["positions"] = packed(positions);
  run["orientations"] = packed(orientations);
  run["base"] = place_of(robot.base_body);
  run["wheels"] = {place_of(robot.mj->geom_bodyid[robot.tyre_geom[0]]),
                   place_of(robot.mj->geom_bodyid[robot.tyre_geom[1]])};
}

void add_beliefs(const VideoSource& source, const scoring::LabelConfig& labels, Json& run) {
  const std::vector<std::size_t> rows = rows_at(source.recording, replay_belief_rate);
  const auto contact = wheels_in_contact(source.recording, labels);
  std::vector<std::uint8_t> truth;
  for (const std::size_t row : rows) truth.push_back(contact[row]);
  run["belief_rate"] = replay_belief_rate;
  run["truth"] = packed(truth);
  run["estimators"] = Json::array();
  for (const BeliefTrack& track : source.beliefs) {
    if (track.p_contact[0].empty() || track.p_contact[1].empty()) continue;
    std::vector<std::uint8_t> codes;
    for (const std::size_t row : rows) {
      for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
        const float p = track.p_contact[wheel][row];
        const long share = std::isfinite(p) ? std::lround(127.0F * std::clamp(p, 0.0F, 1.0F)) : 0;
        const auto& decisions = track.contact[wheel];
        const int decision = (decisions.empty() ? p > 0.5F : decisions[row] != 0) ? 1 : 0;
        codes.push_back(static_cast<std::uint8_t>(2 * share + decision));
      }
    }
    run["estimators"].push_back({{"name", track.name},
                                 {"colour", fmt::format("#{:06x}", track.colour)},
                                 {"beliefs", packed(codes)}});
  }
}

Json camera_json() {
  const SceneCamera camera;
  return {{"azimuth", camera.azimuth},
          {"elevation", camera.elevation},
          {"distance", camera.distance},
          {"look_at", numbers(camera.look_at)}};
}

/// The length of what is left out, in words.
std::string cap_text(const std::vector<VideoSource>& runs) {
  double end = 0.0;
  for (const VideoSource& run : runs) {
    end = std::max(end, run.recording.period() * static_cast<double>(run.recording.steps()));
  }
  return end > longest_replay + 1.0
             ? fmt::format(" Only the first {:.0f} of {:.0f} seconds are here.", longest_replay,
                           end)
             : "";
}

}  // namespace

TriangleMesh reduced(const TriangleMesh& mesh, std::size_t most_triangles) {
  TriangleMesh result = mesh;
  if (mesh.vertices.empty()) return result;
  Eigen::Vector3d low = mesh.vertices.front();
  Eigen::Vector3d high = low;
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  double cells = 256.0;
  while (result.indices.size() > 3 * most_triangles && cells > 1.0) {
    result = on_grid(mesh, low, (high - low).maxCoeff() / cells);
    cells /= 1.25;
  }
  return result;
}

Json replay_data(const std::vector<VideoSource>& runs, const scoring::LabelConfig& labels) {
  Json data = {{"camera", camera_json()}, {"scenes", Json::array()}, {"runs", Json::array()}};
  Json& scenes = data["scenes"];
  for (const VideoSource& source : runs) {
    Json scene = scene_json(source.robot);
    const auto known = std::find(scenes.begin(), scenes.end(), scene);
    Json run = {{"name", label_of(source)}, {"scene", known - scenes.begin()}};
    if (known == scenes.end()) scenes.push_back(std::move(scene));
    add_poses(source, run);
    add_beliefs(source, labels, run);
    run["flights"] = Json::array();
    for (const WheelFlight& flight : wheel_flights(source.recording, labels)) {
      run["flights"].push_back({rounded(flight.takeoff), rounded(flight.landing), flight.wheel});
    }
    data["runs"].push_back(std::move(run));
  }
  return data;
}

std::string replay_html(const std::vector<VideoSource>& runs, const scoring::LabelConfig& labels) {
  Json engines = Json::array();
  for (const VideoSource& run : runs) {
    engines.push_back(
        {{"index", engines.size()}, {"is_first", engines.empty()}, {"name", label_of(run)}});
  }
  return html_of("replay.html", {{"has_engines", engines.size() > 1},
                                 {"engines", std::move(engines)},
                                 {"belief_rate", fmt::format("{:.0f}", replay_belief_rate)},
                                 {"left_out", cap_text(runs)},
                                 {"data", inline_json(replay_data(runs, labels))}});
}

}  // namespace touchdown::render
