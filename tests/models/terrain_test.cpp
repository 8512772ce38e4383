#include "models/terrain.hpp"

#include <cmath>
#include <map>
#include <tuple>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/fields.hpp"
#include "core/files.hpp"
#include "models/profile.hpp"
#include "models/robot_model.hpp"
#include "models/scene_mjcf.hpp"
#include "tests/models/upkie.hpp"

namespace touchdown::models {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;

double height_at(const Terrain& terrain, double x) { return Profile(terrain).height(x); }

std::vector<double> edges(const Terrain& terrain) {
  std::vector<double> result;
  const Profile profile(terrain);
  for (const Profile::Edge& edge : profile.edges()) result.push_back(edge.x);
  return result;
}

Terrain stairs() { return {.pieces = {Flat{3.0}, StairFlight{}}}; }

/// Up a ramp, down a small drop onto a platform, down a large drop to the floor; twice.
Terrain course() {
  return {.pieces = {Flat{1.0}, Ramp{8.0, 0.15}, Step{0.03, 0.025}, Flat{1.5}, Step{0.12, 0.025},
                     Flat{1.5}},
          .start_x = 1.0,
          .repeat = 2};
}

Terrain read(const std::string& text) {
  return from_yaml<Terrain>(YamlDocument::parse(text, "scene.yaml"));
}

TEST(Terrain, DefaultFlightHasItsEdgesAtWholeMetres) {
  EXPECT_THAT(edges(stairs()),
              ElementsAre(DoubleNear(1, 1e-12), DoubleNear(2, 1e-12), DoubleNear(3, 1e-12),
                          DoubleNear(4, 1e-12), DoubleNear(5, 1e-12), DoubleNear(6, 1e-12),
                          DoubleNear(7, 1e-12)));
}

TEST(Terrain, HeightFallsByOneRisePerTreadAndEndsOnTheFloor) {
  const Terrain terrain = stairs();
  EXPECT_EQ(height_at(terrain, -3.0), 0.0);
  EXPECT_DOUBLE_EQ(height_at(terrain, 0.0), 1.75);
  for (int i = 1; i <= 7; ++i) EXPECT_NEAR(height_at(terrain, i + 0.5), 1.75 - 0.25 * i, 1e-12);
  EXPECT_EQ(height_at(terrain, 7.5), 0.0);
  EXPECT_EQ(height_at(terrain, 100.0), 0.0);
  EXPECT_EQ(height_at(Terrain{}, 0.3), 0.0) << "without pieces it is the floor";
  EXPECT_TRUE(edges(Terrain{}).empty());
}

TEST(Terrain, NosingIsAQuarterCircle) {
  const Terrain terrain = stairs();
  const double r = 0.025;
  EXPECT_NEAR(height_at(terrain, 1.0 - r), 1.75, 1e-12);
  EXPECT_NEAR(height_at(terrain, 1.0 - r + r / std::sqrt(2.0)), 1.75 - r + r / std::sqrt(2.0),
              1e-12);
  EXPECT_NEAR(height_at(terrain, std::nextafter(1.0, 0.0)), 1.75 - r, 1e-6);
  EXPECT_NEAR(height_at(terrain, 1.0), 1.5, 1e-12);
}

TEST(Terrain, CourseClimbsAndDropsTwicePerLap) {
  const Terrain terrain = course();
  const double ramp = 0.15 / std::tan(8.0 * M_PI / 180.0);
  const double lap = 1.0 + ramp + 1.5 + 1.5;
  const double first = 1.0 + 1.0 + ramp;
  EXPECT_THAT(edges(terrain),
              ElementsAre(DoubleNear(first, 1e-9), DoubleNear(first + 1.5, 1e-9),
                          DoubleNear(first + lap, 1e-9), DoubleNear(first + lap + 1.5, 1e-9)));
  EXPECT_NEAR(height_at(terrain, 2.0 + 0.5 * ramp), 0.075, 1e-12);
  EXPECT_NEAR(height_at(terrain, first + 0.5), 0.12, 1e-12);
  EXPECT_NEAR(height_at(terrain, first + 2.0), 0.0, 1e-12);
}

TEST(Terrain, TwoFlightsInSequenceMakeAHigherLastDrop) {
  const Terrain terrain{.pieces = {Flat{3.0}, StairFlight{.count = 6}, Step{.drop = 0.5}}};
  EXPECT_EQ(edges(terrain).size(), 7u);
  EXPECT_NEAR(height_at(terrain, 0.0), 2.0, 1e-12);
  EXPECT_NEAR(height_at(terrain, 6.5), 0.5, 1e-12);
}

TEST(Terrain, PlatformStandsOnTheGroundAroundIt) {
  const Terrain terrain{.pieces = {Flat{1.0}, Platform{2.0, 0.4, 0.02}, Flat{1.0}}, .start_x = 0};
  EXPECT_EQ(height_at(terrain, 0.5), 0.0);
  EXPECT_NEAR(height_at(terrain, 1.0), 0.4, 1e-12);
  EXPECT_NEAR(height_at(terrain, 2.9), 0.4, 1e-12);
  EXPECT_EQ(height_at(terrain, 3.5), 0.0);
  EXPECT_THAT(edges(terrain), ElementsAre(DoubleNear(3.0, 1e-12)));
}

TEST(Terrain, OfTheDocumentationCanBeBuilt) {
  const std::string text = read_file(TOUCHDOWN_SOURCE_DIR "/docs/reference/scenarios.md");
  const std::string before = "```yaml\nterrain:\n";
  const std::size_t begin = text.find(before);
  ASSERT_NE(begin, std::string::npos);
  const std::string keys =
      text.substr(begin + before.size(), text.find("```\n", begin + 1) - begin - before.size());
  const auto terrain = from_yaml<Terrain>(YamlDocument::parse(keys, "scenarios.md"));
  EXPECT_EQ(terrain.pieces.size(), 6U);
  EXPECT_EQ(terrain.beside.size(), 1U);
}

TEST(Terrain, RepeatedPartsAreLaidDownInTurn) {
  const Repetition ridges{
      3, {Flat{0.2}, Step{0.01, 0.0}, Repetition{2, {Flat{0.1}}}, Ramp{45.0, 0.01}}};
  const Terrain terrain{.pieces = {Flat{1.0}, ridges, Flat{1.0}, Step{0.05, 0.0}}, .start_x = 0.0};
  EXPECT_THAT(edges(terrain), ElementsAre(DoubleNear(1.2, 1e-9), DoubleNear(1.61, 1e-9),
                                          DoubleNear(2.02, 1e-9), DoubleNear(3.23, 1e-9)));
}

TEST(TerrainYaml, ReadsWhatIsRepeatedAndWhatLiesBeside) {
  const std::string text =
      "pieces:\n  - repeat: {count: 4, pieces: [flat: {length: 0.3}, step: {drop: 0.1}]}\n"
      "beside:\n  - {y: -0.4, width: 0.5, start_x: 2, pieces: [flat: {length: 1}]}\n";
  const Terrain terrain = read(text);
  const auto& ridges = std::get<Repetition>(terrain.pieces.at(0));
  EXPECT_EQ(ridges.count, 4);
  EXPECT_EQ(std::get<Step>(ridges.pieces.at(1)).drop, 0.1);
  ASSERT_EQ(terrain.beside.size(), 1U);
  EXPECT_EQ(terrain.beside[0].y, -0.4);
  EXPECT_EQ(terrain.beside[0].width, 0.5);
  EXPECT_EQ(std::get<Flat>(terrain.beside[0].pieces.at(0)).length, 1.0);
  EXPECT_EQ(YAML::Dump(to_node(read(YAML::Dump(to_node(terrain))))), YAML::Dump(to_node(terrain)));
}

TEST(TerrainYaml, ReadsEveryKindOfPiece) {
  const Terrain terrain = read(
      "start_x: -1\nwidth: 2\nfriction: 0.7\nrepeat: 2\n"
      "pieces:\n  - flat: {length: 2}\n  - stairs: {count: 3, run: 0.8, rise: 0.1}\n"
      "  - ramp: {incline: 10, rise: 0.1}\n  - step: {drop: 0.1, nosing_radius: 0.01}\n"
      "  - platform: {length: 1, height: 0.2}\n");
  ASSERT_EQ(terrain.pieces.size(), 5u);
  EXPECT_EQ(terrain.start_x, -1.0);
  EXPECT_EQ(terrain.repeat, 2);
  EXPECT_EQ(terrain.friction, 0.7);
  EXPECT_EQ(std::get<StairFlight>(terrain.pieces[1]).count, 3);
  EXPECT_EQ(std::get<StairFlight>(terrain.pieces[1]).nosing_radius, 0.025);
  EXPECT_EQ(std::get<Step>(terrain.pieces[3]).nosing_radius, 0.01);
  EXPECT_EQ(std::get<Platform>(terrain.pieces[4]).height, 0.2);
}

TEST(TerrainYaml, WrittenTerrainReadsBackTheSame) {
  for (const Terrain& terrain : {stairs(), course(), Terrain{}}) {
    const YAML::Node node = to_node(terrain);
    const Terrain again = read(YAML::Dump(node));
    EXPECT_EQ(edges(again), edges(terrain));
    EXPECT_EQ(YAML::Dump(to_node(again)), YAML::Dump(node));
  }
}

std::vector<Terrain> all_terrains() {
  return {stairs(), course(),
          Terrain{.pieces = {Flat{3.0}, StairFlight{.count = 6}, Step{.drop = 0.5}}},
          Terrain{.pieces = {Flat{1.0}, Platform{2.0, 0.4, 0.02}, Flat{1.0}}, .start_x = 0},
          Terrain{.pieces = {Ramp{20.0, 0.3}, Flat{0.5}, Platform{0.5, 0.1, 0.0}, Flat{0.5},
                             Ramp{15.0, -0.3}}}};
}

/// Height of the ground that a falling ball would hit beside the robot.
double highest_collider(const mjModel& model, const mjData& data, double x, double y = -1.1) {
  const mjtNum down[3] = {0, 0, -1};
  const mjtByte groups[mjNGROUP] = {0, 0, 0, 1, 0, 0};  // planes are hit whatever their group
  double z = 5.0;
  while (true) {
    const mjtNum from[3] = {x, y, z};
    int geom = -1;
    const double distance = mj_ray(&model, &data, from, down, groups, 1, -1, &geom);
    if (distance < 0) return -1.0;
    z -= distance;
    if (model.geom_contype[geom] != 0) return z;
    z -= 1e-7;  // what is only drawn: look below it
  }
}

/// A ray from above hits the collision geoms at the height of the profile.
TEST(TerrainGeometry, CollisionSurfaceIsTheHeight) {
  for (const Terrain& terrain : all_terrains()) {
    const RobotModel robot = compile_robot_model(upkie_mjcf, terrain);
    const MjDataPtr data(mj_makeData(robot.mj.get()));
    mj_forward(robot.mj.get(), data.get());
    const std::vector<double> all_edges = edges(terrain);
    const Profile profile(terrain);
    for (double x = terrain.start_x - 0.5; x < 9.0; x += 0.00371) {
      // Within a millimetre of a drop the recessed riser leaves a slit.
      bool near_edge = false;
      for (const double edge : all_edges) near_edge |= std::abs(x - edge) < 2e-3;
      if (near_edge) continue;
      EXPECT_NEAR(highest_collider(*robot.mj, *data, x), profile.height(x), 1e-6) << x;
    }
  }
}

TEST(TerrainGeometry, StripsLieBesideEachOther) {
  const Terrain terrain{.pieces = {Flat{3.0}, Step{0.1, 0.01}},
                        .start_x = -1.0,
                        .width = 1.0,
                        .beside = {{{Ramp{10.0, 0.05}, Flat{0.5}, Step{0.05, 0.01}}, 1.0, 1.0, 0.8},
                                   {{Flat{1.0}, Step{0.2, 0.0}}, 0.0, -0.9, 0.4}}};
  const RobotModel robot = compile_robot_model(upkie_mjcf, terrain);
  const MjDataPtr data(mj_makeData(robot.mj.get()));
  mj_forward(robot.mj.get(), data.get());
  const auto height = [&](double x, double y) { return highest_collider(*robot.mj, *data, x, y); };
  EXPECT_NEAR(height(1.6, 0.2), 0.1, 1e-6);  // what the robot starts on
  EXPECT_NEAR(height(1.6, 1.0), 0.05, 1e-6);
  EXPECT_NEAR(height(1.0 + 0.5 * 0.05 / std::tan(M_PI / 18.0), 1.3), 0.025, 1e-6);
  EXPECT_NEAR(height(0.5, -1.0), 0.2, 1e-6);
  for (const double y : {0.55, 1.45, -0.65, -1.15}) EXPECT_NEAR(height(0.5, y), 0.0, 1e-6) << y;
}

using Point = std::tuple<long, long, long>;

Point rounded(const Eigen::Vector3d& p) {
  return {std::lround(1e7 * p.x()), std::lround(1e7 * p.y()), std::lround(1e7 * p.z())};
}

/// The drawn meshes are closed, their normals point outwards, and the volume that they enclose is
/// the area under the profile times the width.
TEST(TerrainMesh, EnclosesTheGroundAboveTheFloor) {
  for (const Terrain& terrain : all_terrains()) {
    double volume = 0.0;
    const std::vector<Mesh> meshes = visual_meshes(Profile(terrain), terrain.width);
    EXPECT_FALSE(meshes.empty());
    for (const Mesh& mesh : meshes) {
      std::map<std::pair<Point, Point>, int> uses;
      for (const auto& face : mesh.faces) {
        std::array<Eigen::Vector3d, 3> p, n;
        for (std::size_t k = 0; k < 3; ++k) {
          const Mesh::Vertex& v = mesh.vertices[static_cast<std::size_t>(face[k])];
          p[k] = {v.x, v.y, v.z};
          n[k] = {v.nx, v.ny, v.nz};
        }
        volume += p[0].dot(p[1].cross(p[2])) / 6.0;
        const Eigen::Vector3d outward = (p[1] - p[0]).cross(p[2] - p[0]).normalized();
        for (std::size_t k = 0; k < 3; ++k) {
          EXPECT_NEAR(n[k].norm(), 1.0, 1e-9);
          EXPECT_GT(n[k].dot(outward), 0.9);
          ASSERT_NE(rounded(p[k]), rounded(p[(k + 1) % 3]));
          ++uses[{rounded(p[k]), rounded(p[(k + 1) % 3])}];
        }
      }
      for (const auto& [edge, count] : uses) {
        EXPECT_EQ(count, 1);
        EXPECT_EQ(uses.count({edge.second, edge.first}), 1u);
      }
    }
    double area = 0.0;
    const double dx = 1e-4;
    const Profile profile(terrain);
    for (double x = terrain.start_x - 0.1; x < 15.0; x += dx) area += dx * profile.height(x);
    EXPECT_NEAR(volume, area * terrain.width, 2e-3 * volume);
  }
}

/// A ball at rest on the terrain has the terrain's friction, not the robot's.
TEST(TerrainGeometry, TerrainDecidesFrictionAndStiffness) {
  Terrain terrain;
  terrain.friction = 0.37;
  const RobotModel robot = compile_robot_model(upkie_mjcf, terrain);
  const MjDataPtr data(mj_makeData(robot.mj.get()));
  data->qpos[2] = 0.5565;  // tyres half a millimetre into the floor
  mj_forward(robot.mj.get(), data.get());
  ASSERT_EQ(data->ncon, 2);
  for (int i = 0; i < data->ncon; ++i) {
    EXPECT_DOUBLE_EQ(data->contact[i].friction[0], 0.37);
    EXPECT_DOUBLE_EQ(data->contact[i].solref[0], 0.01);
    EXPECT_EQ(data->contact[i].dim, 3);
  }
}

}  // namespace
}  // namespace touchdown::models
