#include "scenarios/scenario.hpp"

#include <algorithm>
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

static void describe(Fields& fields, Deviations& deviations) {
  fields("com_x", deviations.com_x, -1.0, 1.0);
  fields("com_z", deviations.com_z, -1.0, 1.0);
  fields("wheel_radius_scale", deviations.wheel_radius_scale, 0.1, 10.0);
  fields("actuator_friction_scale", deviations.actuator_friction_scale, 0.0, 10.0);
  std::vector<double> errors(deviations.torque_error.begin(), deviations.torque_error.end());
  fields.in_line("torque_error", errors);
  fields.check(errors.size() == models::servo_count &&
                   std::all_of(errors.begin(), errors.end(),
                               [](double error) { return -0.9 <= error && error <= 10.0; }),
               "torque_error", "expected six numbers from -0.9 to 10, one for each servo");
  std::copy_n(errors.begin(), std::min(errors.size(), deviations.torque_error.size()),
              deviations.torque_error.begin());
}

static void describe(Fields& fields, Scenario& scenario, const policies::LqrGains& lqr) {
  fields.require("name", scenario.name);
  fields.check(is_name_word(scenario.name), "name", expected_name_word);
  std::string robot = scenario.robot.string();
  fields("robot", robot);
  scenario.robot = robot;
  fields.section("terrain", scenario.terrain);
  fields.section("start", scenario.start);
  fields.section("balancer", scenario.balancer, lqr);
  fields.know("policy");
  if (fields.present("policy", scenario.policy != policies::PolicyConfig{})) {
    fields.section("policy", scenario.policy);
  }
  fields.list("velocity", scenario.velocity, scenario.velocity);
  fields.list_if_any("crouch", scenario.crouch, scenario.crouch);
  fields.section("tether", scenario.tether);
  fields.list_if_any("guides", scenario.guides);
  fields.list_if_any("forces", scenario.forces);
  double reference_mass = scenario.forces_for_mass.value_or(0.0);
  if (fields.reading() || reference_mass > 0.0)
    fields("forces_for_mass", reference_mass, 0.01, 1e4);
  if (reference_mass > 0.0) scenario.forces_for_mass = reference_mass;
  fields("mass_scale", scenario.mass_scale, 0.01, 100.0);
  fields.know("deviations");
  if (fields.present("deviations", scenario.deviations != Deviations{})) {
    fields.section("deviations", scenario.deviations);
  }
  fields.section("simulation", scenario.simulation);
  fields.section("end", scenario.end);
  fields.section("perturbation", scenario.perturbation);
}

Scenario scenario_from_yaml(const YamlDocument& document, const Scenario& defaults,
                            const policies::LqrGains& lqr) {
  Scenario scenario = defaults;
  Fields fields(document);
  describe(fields, scenario, lqr);
  fields.finish();
  return scenario;
}

Scenario load_scenario(const std::filesystem::path& path) {
  return scenario_from_yaml(YamlDocument::load(path));
}

std::string robot_text(const Scenario& scenario) {
  return models::robot_text(find_resource(scenario.robot));
}

std::string to_yaml(const Scenario& scenario) {
  Fields fields;
  Scenario written = scenario;
  describe(fields, written, {});
  return YAML::Dump(fields.node()) + "\n";
}

Scenario perturbed(const Scenario& scenario, std::uint64_t seed, std::int64_t run) {
  // The numbers of the streams define what a seed draws: append, never renumber.
  enum Stream : std::uint64_t {
    x,
    y,
    yaw,
    velocity,
    crouch,
    mass,
    friction,
    servo_gain,
    force,
    com_x,
    com_z,
    wheel_radius,
    actuator_friction,
    torque_error  // the first of six: one stream per servo
  };
  const auto draw = [&](std::uint64_t stream, double half_width) {
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
  Deviations& deviations = varied.deviations;
  deviations.com_x += draw(com_x, p.com_x);
  deviations.com_z += draw(com_z, p.com_z);
  deviations.wheel_radius_scale *= 1.0 + draw(wheel_radius, p.wheel_radius_scale);
  deviations.actuator_friction_scale *= 1.0 + draw(actuator_friction, p.actuator_friction_scale);
  for (std::size_t i = 0; i < deviations.torque_error.size(); ++i) {
    deviations.torque_error[i] += draw(torque_error + i, p.torque_error);
  }
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
