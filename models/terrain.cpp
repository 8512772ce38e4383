#include "models/terrain.hpp"

#include <utility>

#include "models/profile.hpp"

namespace touchdown {
namespace {

TerrainPiece piece_from_yaml(YamlMap& item) {
  if (!item.node().IsMap() || item.node().size() != 1) {
    item.fail("piece", "expected one of flat, stairs, ramp, platform, step");
  }
  TerrainPiece piece;
  if (item.has("flat")) {
    YamlMap map = item.child("flat");
    Flat flat;
    map.read("length", flat.length, 1e-3, 1000.0);
    map.finish();
    piece = flat;
  } else if (item.has("stairs")) {
    YamlMap map = item.child("stairs");
    StairFlight stairs;
    map.read("count", stairs.count, 1, 1000);
    map.read("run", stairs.run, 0.02, 100.0);
    map.read("rise", stairs.rise, 1e-3, 10.0);
    map.read("nosing_radius", stairs.nosing_radius, 0.0, 1.0);
    map.finish();
    piece = stairs;
  } else if (item.has("ramp")) {
    YamlMap map = item.child("ramp");
    Ramp ramp;
    map.read("incline", ramp.incline, 0.1, 60.0);
    map.read("rise", ramp.rise, -10.0, 10.0);
    if (ramp.rise == 0.0) map.fail("rise", "expected anything but 0; `flat` is for level ground");
    map.finish();
    piece = ramp;
  } else if (item.has("platform")) {
    YamlMap map = item.child("platform");
    Platform platform;
    map.read("length", platform.length, 0.02, 1000.0);
    map.read("height", platform.height, 1e-3, 10.0);
    map.read("nosing_radius", platform.nosing_radius, 0.0, 1.0);
    map.finish();
    piece = platform;
  } else if (item.has("step")) {
    YamlMap map = item.child("step");
    Step step;
    map.read("drop", step.drop, 1e-3, 10.0);
    map.read("nosing_radius", step.nosing_radius, 0.0, 1.0);
    map.finish();
    piece = step;
  }
  for (const char* kind : {"flat", "stairs", "ramp", "platform", "step"}) (void)item.take(kind);
  item.finish();
  return piece;
}

struct ToYaml {
  YAML::Node operator()(const Flat& flat) const {
    YAML::Node node;
    node["flat"]["length"] = flat.length;
    return node;
  }
  YAML::Node operator()(const StairFlight& stairs) const {
    YAML::Node node;
    node["stairs"]["count"] = stairs.count;
    node["stairs"]["run"] = stairs.run;
    node["stairs"]["rise"] = stairs.rise;
    node["stairs"]["nosing_radius"] = stairs.nosing_radius;
    return node;
  }
  YAML::Node operator()(const Ramp& ramp) const {
    YAML::Node node;
    node["ramp"]["incline"] = ramp.incline;
    node["ramp"]["rise"] = ramp.rise;
    return node;
  }
  YAML::Node operator()(const Platform& platform) const {
    YAML::Node node;
    node["platform"]["length"] = platform.length;
    node["platform"]["height"] = platform.height;
    node["platform"]["nosing_radius"] = platform.nosing_radius;
    return node;
  }
  YAML::Node operator()(const Step& step) const {
    YAML::Node node;
    node["step"]["drop"] = step.drop;
    node["step"]["nosing_radius"] = step.nosing_radius;
    return node;
  }
};

}  // namespace

Terrain terrain_from_yaml(YamlMap&& map) {
  Terrain terrain;
  map.read("start_x", terrain.start_x, -1000.0, 1000.0);
  map.read("width", terrain.width, 0.1, 1000.0);
  map.read("repeat", terrain.repeat, 1, 1000);
  map.read("friction", terrain.friction, 0.0, 10.0);
  for (YamlMap& item : map.children("pieces")) terrain.pieces.push_back(piece_from_yaml(item));
  map.finish();
  try {
    (void)Profile(terrain);
  } catch (const InputError& error) {
    map.fail("pieces", error.what());
  }
  return terrain;
}

YAML::Node to_yaml(const Terrain& terrain) {
  YAML::Node node;
  node["start_x"] = terrain.start_x;
  node["width"] = terrain.width;
  node["repeat"] = terrain.repeat;
  node["friction"] = terrain.friction;
  node["pieces"] = YAML::Node(YAML::NodeType::Sequence);
  for (const TerrainPiece& piece : terrain.pieces) {
    node["pieces"].push_back(std::visit(ToYaml{}, piece));
  }
  return node;
}

double height_at(const Terrain& terrain, double x) { return Profile(terrain).height(x); }

std::vector<double> edges(const Terrain& terrain) {
  std::vector<double> result;
  const Profile profile(terrain);
  for (const Profile::Edge& edge : profile.edges()) result.push_back(edge.x);
  return result;
}

}  // namespace touchdown
