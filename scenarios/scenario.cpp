#include "scenarios/scenario.hpp"

#include <cmath>

#include "core/fields.hpp"
#include "core/file_names.hpp"
#include "core/random.hpp"
#include "core/resources.hpp"
#include "models/robot_description.hpp"
#include "models/terrain_yaml.hpp"

namespace touchdown::scenarios {

static void describe(Fields& fields, Start& start) {
  fields("x", start.x, -1e3, 1e3);
  fields("y", start.y, -1e3, 1e3);
  fields("yaw", start.yaw, -3.2, 3.2);
  fields("hip", start.hip, -1.26, 1.26);
  fields("knee", start.knee, -2.51, 2.51);
  fields("clearance", start.clearance, 0.0, 100.0);
}

static void describe(Fields& fields, End& end) {
  fields("duration", end.duration, 1e-3, 1e5);
  if (fields.reading() || std::isfinite(end.x)) fields("x", end.x);
  fields("settle", end.settle, 0.0, 1e3);
  fields("fall_tilt", end.fall_tilt, 0.1, 3.2);
}

static void describe(Fields& fields, Scenario& scenario) {
  fields.require("name", scenario.name);
  fields.check(is_name_word(scenario.name), "name", expected_name_word);
  std::string robot = scenario.robot.string();
  fields("robot", robot);
  scenario.robot = robot;
  fields.section("terrain", scenario.terrain);
  fields.section("start", scenario.start);
  fields.section("balancer", scenario.balancer);
  fields.list("velocity", scenario.velocity, scenario.velocity);
  fields.list_if_any("crouch", scenario.crouch, scenario.crouch);
  fields.section("tether", scenario.tether);
  fields.list_if_any("guides", scenario.guides);
  fields.list_if_any("forces", scenario.forces);
  fields("mass_scale", scenario.mass_scale, 0.01, 100.0);
  fields.section("simulation", scenario.simulation);
  fields.section("end", scenario.end);
  fields.section("perturbation", scenario.perturbation);
}

Scenario scenario_from_yaml(const YamlDocument& document) { return from_yaml<Scenario>(document); }

Scenario load_scenario(const std::filesystem::path& path) {
  return scenario_from_yaml(YamlDocument::load(path));
}

Scenario find_scenario(const std::filesystem::path& path) {
  Scenario scenario = load_scenario(find_resource(path));
  scenario.robot = find_resource(scenario.robot);
  return scenario;
}

std::string robot_text(const Scenario& scenario) {
  return models::robot_text(find_resource(scenario.robot));
}

std::string to_yaml(const Scenario& scenario) { return YAML::Dump(to_node(scenario)) + "\n"; }

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
  for (policies::VelocityCommand& command : varied.velocity) {
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
  for (policies::TimedForce& timed : varied.forces) timed.force *= stronger;
  const double duration = scenario.end.duration;
  if (p.drive) varied.velocity = random_drive(*p.drive, duration, seed, run);
  if (p.crouching) varied.crouch = random_crouches(*p.crouching, duration, seed, run);
  if (p.lift) {
    const policies::ForceScript lifts = random_lifts(*p.lift, duration, seed, run);
    varied.forces.insert(varied.forces.end(), lifts.begin(), lifts.end());
  }
  varied.perturbation = {};
  return varied;
}

}  // namespace touchdown::scenarios
