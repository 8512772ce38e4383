#include "scenarios/scenario.hpp"

#include <cmath>

#include "core/random.hpp"

namespace touchdown {

namespace {

Start start_from_yaml(YamlMap map) {
  Start start;
  map.read("x", start.x, -1e3, 1e3);
  map.read("y", start.y, -1e3, 1e3);
  map.read("yaw", start.yaw, -3.2, 3.2);
  map.read("hip", start.hip, -1.26, 1.26);
  map.read("knee", start.knee, -2.51, 2.51);
  map.read("clearance", start.clearance, 0.0, 100.0);
  map.finish();
  return start;
}

YAML::Node to_yaml(const Start& start) {
  YAML::Node node;
  node["x"] = start.x;
  node["y"] = start.y;
  node["yaw"] = start.yaw;
  node["hip"] = start.hip;
  node["knee"] = start.knee;
  node["clearance"] = start.clearance;
  return node;
}

End end_from_yaml(YamlMap map) {
  End end;
  map.read("duration", end.duration, 1e-3, 1e5);
  map.read("x", end.x);
  map.read("settle", end.settle, 0.0, 1e3);
  map.read("fall_tilt", end.fall_tilt, 0.1, 3.2);
  map.finish();
  return end;
}

YAML::Node to_yaml(const End& end) {
  YAML::Node node;
  node["duration"] = end.duration;
  if (std::isfinite(end.x)) node["x"] = end.x;
  node["settle"] = end.settle;
  node["fall_tilt"] = end.fall_tilt;
  return node;
}

}  // namespace

Scenario scenario_from_yaml(const YamlDocument& document) {
  YamlMap map(document);
  Scenario scenario;
  map.require("name", scenario.name);
  std::string robot = scenario.robot.string();
  map.read("robot", robot);
  scenario.robot = robot;
  scenario.terrain = terrain_from_yaml(map.child("terrain"));
  scenario.start = start_from_yaml(map.child("start"));
  scenario.balancer = wheel_balancer_from_yaml(map.child("balancer"));
  scenario.velocity = velocity_script_from_yaml(map, "velocity");
  if (map.has("tether")) scenario.tether = tether_from_yaml(map.child("tether"));
  for (YamlMap& guide : map.children("guides")) {
    scenario.guides.push_back(guide_from_yaml(std::move(guide)));
  }
  scenario.forces = force_script_from_yaml(map, "forces");
  map.read("mass_scale", scenario.mass_scale, 0.01, 100.0);
  scenario.simulation = simulator_options_from_yaml(map.child("simulation"));
  scenario.end = end_from_yaml(map.child("end"));
  scenario.perturbation = perturbation_from_yaml(map.child("perturbation"));
  map.finish();
  return scenario;
}

Scenario load_scenario(const std::filesystem::path& path) {
  return scenario_from_yaml(YamlDocument::load(path));
}

std::string to_yaml(const Scenario& scenario) {
  YAML::Node node;
  node["name"] = scenario.name;
  node["robot"] = scenario.robot.string();
  node["terrain"] = to_yaml(scenario.terrain);
  node["start"] = to_yaml(scenario.start);
  node["balancer"] = to_yaml(scenario.balancer);
  node["velocity"] = to_yaml(scenario.velocity);
  if (scenario.tether) node["tether"] = to_yaml(*scenario.tether);
  for (const Guide& guide : scenario.guides) node["guides"].push_back(to_yaml(guide));
  if (!scenario.forces.empty()) node["forces"] = to_yaml(scenario.forces);
  node["mass_scale"] = scenario.mass_scale;
  node["simulation"] = to_yaml(scenario.simulation);
  node["end"] = to_yaml(scenario.end);
  node["perturbation"] = to_yaml(scenario.perturbation);
  YAML::Emitter out;
  out.SetDoublePrecision(17);
  out << node;
  return std::string(out.c_str()) + "\n";
}

Scenario perturbed(const Scenario& scenario, std::uint64_t seed, std::int64_t run) {
  // The numbers of the streams are part of what a seed means: append, never renumber.
  enum Stream : std::uint64_t { x, y, yaw, velocity, crouch, mass, friction, servo_gain, force };
  const auto draw = [&](Stream stream, double half_width) {
    return half_width * (2.0 * uniform01(seed, static_cast<std::uint64_t>(run), stream) - 1.0);
  };
  const Perturbation& p = scenario.perturbation;
  Scenario varied = scenario;
  varied.start.x += draw(x, p.x);
  varied.start.y += draw(y, p.y);
  varied.start.yaw += draw(yaw, p.yaw);
  const double faster = draw(velocity, p.velocity);
  for (VelocityCommand& command : varied.velocity) {
    if (command.velocity != 0.0) command.velocity += faster;
  }
  const double deeper = draw(crouch, p.crouch);
  if (scenario.start.hip != 0.0) {
    varied.start.knee *= (scenario.start.hip + deeper) / scenario.start.hip;
  }
  varied.start.hip += deeper;
  varied.mass_scale *= 1.0 + draw(mass, p.mass_scale);
  varied.terrain.friction = std::max(0.0, scenario.terrain.friction + draw(friction, p.friction));
  const double stiffer = 1.0 + draw(servo_gain, p.servo_gain_scale);
  varied.balancer.leg_kp_scale *= stiffer;
  varied.balancer.leg_kd_scale *= stiffer;
  const double stronger = 1.0 + draw(force, p.force_scale);
  for (TimedForce& timed : varied.forces) timed.force *= stronger;
  const double duration = scenario.end.duration;
  if (p.drive) varied.velocity = random_drive(*p.drive, duration, seed, run);
  if (p.lift) {
    const ForceScript lifts = random_lifts(*p.lift, duration, seed, run);
    varied.forces.insert(varied.forces.end(), lifts.begin(), lifts.end());
  }
  varied.perturbation = {};
  return varied;
}

}  // namespace touchdown
