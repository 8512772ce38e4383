#include "scenarios/scenario.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/fields.hpp"
#include "core/files.hpp"
#include "core/random.hpp"
#include "core/resources.hpp"
#include "models/robot_description.hpp"
#include "models/terrain.hpp"

namespace touchdown::scenarios {

namespace {

/// The cause of a fall. Both causes may hold at once; the tilt then explains the touch.
std::string cause_of_fall(const models::GroundTruth& truth, double limit) {
  const Eigen::Matrix3d base_to_world = truth.base_orientation.normalized().toRotationMatrix();
  if (base_to_world(2, 2) >= std::cos(limit)) return "a part other than a tyre touched the terrain";
  const double pitch = std::asin(std::clamp(-base_to_world(2, 0), -1.0, 1.0));
  const double roll = std::asin(std::clamp(base_to_world(2, 1), -1.0, 1.0));
  return fmt::format("{} beyond {:g} rad", std::abs(pitch) >= std::abs(roll) ? "pitch" : "roll",
                     limit);
}

std::string cause(const logs::Recording& recording, const End& end) {
  const models::GroundTruth& truth = recording.truth.back();
  switch (*recording.info.outcome) {
    case logs::Outcome::fell:
      return cause_of_fall(truth, end.fall_tilt);
    case logs::Outcome::timed_out:
      return fmt::format("at x = {:.2f} m, before the finish line at {:g} m",
                         truth.base_position.x(), end.x);
    case logs::Outcome::diverged:
      return "position or velocity not finite, or too large to be physical";
    case logs::Outcome::left_terrain:
      return "the base is below the floor";
    case logs::Outcome::finished:
      break;
  }
  return {};
}

}  // namespace

std::string outcome_text(logs::Outcome outcome) {
  if (outcome == logs::Outcome::left_terrain) return "left the terrain";
  std::string text(logs::to_text(outcome));
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

std::string ending_text(const logs::Recording& recording, const End& end) {
  const double duration = static_cast<double>(recording.steps()) * recording.period();
  if (!recording.info.outcome) return fmt::format("stopped after {:.3f} s", duration);
  const std::string ended =
      fmt::format("{} after {:.3f} s", outcome_text(*recording.info.outcome), duration);
  const std::string why = recording.truth.empty() ? "" : cause(recording, end);
  return why.empty() ? ended : ended + ": " + why;
}

static void describe(Fields& fields, Start& start) {
  fields("x", start.x, -1e3, 1e3).doc("m", "Position of the wheels along the course.");
  fields("y", start.y, -1e3, 1e3).doc("m", "Position of the wheels across the course.");
  fields("yaw", start.yaw, -3.2, 3.2).doc("rad", "Heading, positive to the left.");
  fields("hip", start.hip, -policies::largest_angle, policies::largest_angle)
      .doc("rad",
           "Hip angle, forward from a straight leg, within the joint's range. A robot's file "
           "may set another default.");
  fields("knee", start.knee, -policies::largest_angle, policies::largest_angle)
      .doc("rad",
           "Knee angle, backward from a straight leg, within the joint's range. A robot's "
           "file may set another default.");
  fields("clearance", start.clearance, 0.0, 100.0)
      .doc("m", "Height of the tyres above the ground.");
}

static void describe(Fields& fields, End& end) {
  fields("duration", end.duration, 1e-3, 1e5).doc("s", "Longest duration of the run.");
  fields.if_set(std::isfinite(end.x), "x", end.x)
      .doc("m", "Finish line of the base along the course.");
  fields("settle", end.settle, 0.0, 1e3)
      .doc("s", "The run ends this long after the base passed the finish line.");
  fields("fall_tilt", end.fall_tilt, 0.1, 3.2).doc("rad", "A larger tilt is a fall.");
}

static void describe(Fields& fields, Deviations& deviations) {
  fields("com_x", deviations.com_x, -1.0, 1.0)
      .doc("m", "Offset of the base body's centre of mass, forward.");
  fields("com_z", deviations.com_z, -1.0, 1.0)
      .doc("m", "Offset of the base body's centre of mass, upward.");
  fields("payload", deviations.payload, 0.0, 1e4)
      .doc("kg", "What the base body carries at its centre of mass; estimators do not know of it.");
  fields("wheel_radius_scale", deviations.wheel_radius_scale, 0.1, 10.0)
      .doc("Factor on the radius of both wheels.");
  fields("actuator_friction_scale", deviations.actuator_friction_scale, 0.0, 10.0)
      .doc("Factor on the friction of every joint.");
  std::vector<double> errors(deviations.torque_error.begin(), deviations.torque_error.end());
  fields.in_line("torque_error", errors)
      .range("six of -0.9 to 10")
      .doc("Errors of the six servos' torque constants, added to the robot's.");
  fields.check(errors.size() == models::servo_count &&
                   std::all_of(errors.begin(), errors.end(),
                               [](double error) { return -0.9 <= error && error <= 10.0; }),
               "torque_error", "expected six numbers from -0.9 to 10, one for each servo");
  std::copy_n(errors.begin(), std::min(errors.size(), deviations.torque_error.size()),
              deviations.torque_error.begin());
}

static void describe(Fields& fields, Scenario& scenario, const policies::LqrGains& lqr) {
  fields.require("name", scenario.name).doc("Name in tables and files.");
  fields.check(is_name_word(scenario.name), "name", expected_name_word);
  std::string robot = scenario.robot.string();
  fields("robot", robot).doc("Robot: an MJCF, or a YAML file about one.");
  scenario.robot = robot;
  fields.section("tyre", scenario.tyre).doc("Contact model of both tyres, instead of the robot's.");
  fields.section("terrain", scenario.terrain)
      .doc("The ground, as pieces laid end to end on a floor.");
  fields.section("start", scenario.start).doc("Position and stance at the start.");
  fields.section("balancer", scenario.balancer, lqr)
      .doc("Gains of the balancer; otherwise the robot's own.");
  fields.section_if_set(scenario.policy != policies::PolicyConfig{}, "policy", scenario.policy)
      .doc("Control law and its contact source.");
  fields.list("velocity", scenario.velocity, scenario.velocity)
      .doc("Drive commands, each from its time on.");
  fields.list_if_any("crouch", scenario.crouch, scenario.crouch)
      .doc("Crouch commands, each from its time on.");
  fields.if_set(scenario.clip_crouches, "clip_crouches", scenario.clip_crouches)
      .doc("Crouches beyond the ranges of the robot's joints end there, instead of being refused.");
  fields.section("tether", scenario.tether).doc("A rope that holds the robot.");
  fields.list_if_any("guides", scenario.guides)
      .doc("Horizontal springs that keep the robot above a place.");
  fields.list_if_any("forces", scenario.forces).doc("Forces on the base, such as pushes.");
  fields.optional("forces_for_mass", scenario.forces_for_mass, 0.01, 1e4)
      .doc("kg",
           "Mass that forces, lifts and tyre are written for; they scale with the robot's mass.");
  fields("mass_scale", scenario.mass_scale, 0.01, 100.0)
      .doc("Factor on mass and inertia of every body.");
  fields.section_if_set(scenario.deviations != Deviations{}, "deviations", scenario.deviations)
      .doc("How the robot differs from its description.");
  fields.section("simulation", scenario.simulation).doc("Time steps and contact model.");
  fields.section("end", scenario.end).doc("When a run is over.");
  fields.section("perturbation", scenario.perturbation)
      .doc("Half widths of what varies from run to run, `_scale` as a share.");
}

std::vector<Key> scenario_keys() {
  const policies::LqrGains any = [](const policies::WheelBalancerConfig& config) { return config; };
  return documented_keys(Scenario(), any);
}

Scenario scenario_from_yaml(const YamlDocument& document, const Scenario& defaults,
                            const policies::LqrGains& lqr) {
  Scenario scenario = defaults;
  Fields fields(document);
  describe(fields, scenario, lqr);
  fields.finish();
  return scenario;
}

std::string robot_digest(const Scenario& scenario) {
  return models::robot_digest(find_resource(scenario.robot));
}

std::string to_yaml(const Scenario& scenario) {
  Fields fields;
  Scenario written = scenario;
  describe(fields, written, {});
  return YAML::Dump(fields.node()) + "\n";
}

namespace {

/// The drawn change of a hip angle. Legs keep a bend of at least `least_bend`: straight legs are
/// singular, and beyond them the knees bend backwards. The half width towards straight legs ends
/// there.
double bent(double hip, double change, double half_width) {
  const double room = std::max(0.0, std::abs(hip) - least_bend);
  if (change * hip >= 0.0 || half_width <= room) return change;
  return change * room / half_width;
}

}  // namespace

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
  const double deeper = bent(scenario.start.hip, draw(crouch, p.crouch), p.crouch);
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
