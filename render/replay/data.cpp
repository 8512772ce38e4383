#include "render/replay/data.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "render/film/scene_view.hpp"
#include "render/replay/encoding.hpp"
#include "render/film/primitives.hpp"

namespace touchdown::render {

namespace {

using Json = nlohmann::ordered_json;

/// Meshes of a scene have together about this many triangles at most.
constexpr std::size_t most_mesh_triangles = 40'000;

double rounded(double value) { return std::round(value * 1e5) / 1e5; }

Json numbers(const Eigen::Vector3d& v) { return {rounded(v.x()), rounded(v.y()), rounded(v.z())}; }

Json mesh_json(const mjModel& model, int mesh, std::size_t most_triangles) {
  TriangleMesh all;
  const std::span<const float> vertices = mesh_vertices(model, mesh);
  for (std::size_t i = 0; i + 2 < vertices.size(); i += 3) {
    all.vertices.emplace_back(vertices[i], vertices[i + 1], vertices[i + 2]);
  }
  const std::span<const int> triangles = mesh_triangles(model, mesh);
  all.indices.assign(triangles.begin(), triangles.end());
  const TriangleMesh shown = reduced(all, most_triangles);
  const PositionCode code = code_of(shown.vertices);
  std::vector<double> offsets;
  for (const Eigen::Vector3d& vertex : shown.vertices) {
    const Eigen::Vector3d offset = vertex - code.origin;
    offsets.insert(offsets.end(), offset.begin(), offset.end());
  }
  return {{"origin", numbers(code.origin)},
          {"unit", code.unit},
          {"vertices", packed(offsets, code.unit)},
          {"triangles", shown.indices}};
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
std::vector<std::size_t> rows_at(const recordings::Recording& recording, double rate) {
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
  std::vector<Eigen::Vector3d> positions;
  std::vector<double> orientations;
  for (const std::size_t row : rows) {
    poses.apply(row, *data);
    for (std::size_t i = 1; i < bodies.size(); ++i) {
      positions.push_back(body_position(*data, bodies[i]));
      const Eigen::Quaterniond q = body_orientation(*data, bodies[i]);
      for (const double number : {q.w(), q.x(), q.y(), q.z()}) orientations.push_back(number);
    }
  }
  const PositionCode code = code_of(positions);
  std::vector<double> offsets;
  for (const Eigen::Vector3d& position : positions) {
    const Eigen::Vector3d offset = position - code.origin;
    offsets.insert(offsets.end(), offset.begin(), offset.end());
  }
  const auto place_of = [&](int body) {
    return std::find(bodies.begin(), bodies.end(), body) - bodies.begin();
  };
  run["pose_rate"] = replay_pose_rate;
  run["origin"] = numbers(code.origin);
  run["unit"] = code.unit;
  run["positions"] = packed(offsets, code.unit);
  run["orientations"] = packed(orientations, 1.0 / 32767.0);
  run["base"] = place_of(robot.base_body);
  run["wheels"] = {place_of(robot.mj->geom_bodyid[robot.tyre_geom[0]]),
                   place_of(robot.mj->geom_bodyid[robot.tyre_geom[1]])};
}

void add_beliefs(const VideoSource& source, const scoring::LabelConfig& labels, Json& run) {
  const std::vector<std::size_t> rows = rows_at(source.recording, replay_belief_rate);
  const auto contact = scoring::contact_labels(source.recording, labels);
  std::vector<std::uint8_t> truth;
  for (const std::size_t row : rows) {
    truth.push_back(
        static_cast<std::uint8_t>((contact[0][row] != 0 ? 1 : 0) + (contact[1][row] != 0 ? 2 : 0)));
  }
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

}  // namespace

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
    for (const scoring::Flight& flight : visible_flights(source.recording, labels)) {
      run["flights"].push_back(
          {rounded(static_cast<double>(flight.takeoff) * source.recording.period()),
           rounded(static_cast<double>(flight.landing) * source.recording.period())});
    }
    data["runs"].push_back(std::move(run));
  }
  return data;
}

}  // namespace touchdown::render
