#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenarios/generation/families.hpp"

namespace touchdown::scenarios {

namespace {

const Eigen::Vector3d handle(0.0, 0.0, 0.06);  // base frame (m)

constexpr Range usual_hold = {0.3, 1.2};  // s
// The longer a force takes to fade, the further the robot goes on upwards.
constexpr Range slow_weight = {1.01, 1.05};

/// Hands that keep the torso upright and carry no load.
std::vector<policies::Guide> hands() {
  return {{.point_in_base = handle, .stiffness = 400.0, .damping = 60.0},
          {.point_in_base = {0.0, 0.0, -0.25}, .stiffness = 400.0, .damping = 60.0}};
}

/// Forces upwards, each of which grows and fades within times of `ramp`, or at once.
struct Lifts {
  Range ramp;    ///< s
  Range hold;    ///< s
  Range weight;  ///< shares of the robot's
};

Scenario lifted(const Draws& draws, const Lifts& lifts) {
  Scenario scenario;
  scenario.guides = hands();
  scenario.forces_for_mass = written_mass;
  scenario.mass_scale = draws.between("mass_scale", 0.9, 1.1);
  const double weight = written_mass * scenario.mass_scale * scene_gravity;
  const int count = draws.whole("count", 1, 3);
  double time = draws.between("start", 1.0, 2.0);
  for (int i = 0; i < count; ++i) {
    const Draws lift = draws.of("lift", i);
    const auto ramp = [&](std::string_view quantity) {
      const Range& of = lifts.ramp;
      return of.high > 0.0 ? lift.log_between(quantity, of.low, of.high) : 0.0;
    };
    policies::TimedForce force{.time = time, .point_in_base = handle};
    force.rise = ramp("rise");
    force.fall = ramp("fall");
    force.duration =
        force.rise + lift.between("hold", lifts.hold.low, lifts.hold.high) + force.fall;
    force.force.z() = weight * lift.between("force", lifts.weight.low, lifts.weight.high);
    scenario.forces.push_back(force);
    time += force.duration + lift.between("pause", 0.8, 1.8);
  }
  scenario.terrain.friction = draws.between("friction", 0.3, 1.0);
  scenario.end.duration = time + 0.5;
  scenario.perturbation.yaw = 0.3;
  scenario.perturbation.crouch = 0.1;
  return scenario;
}

}  // namespace

Scenario draw_lifts(const Draws& draws) { return lifted(draws, {{}, usual_hold, {1.01, 1.12}}); }

Scenario draw_slow_lifts(const Draws& draws) {
  return lifted(draws, {{0.2, 10.0}, usual_hold, slow_weight});
}

Scenario draw_light_stands(const Draws& draws) {
  Scenario scenario = lifted(draws, {{0.05, 2.0}, {1.0, 5.0}, {0.5, 0.9}});
  if (draws.happens("rope", 0.3)) {
    // Soft, so that its pull hardly depends on the height of the handle, some .55 m above ground.
    constexpr double handle_height = 0.55;
    const double pull = draws.between("pull", 0.5, 0.95) * written_mass * scene_gravity;
    policies::Tether tether{.length = 0.5,
                            .stiffness = draws.log_between("rope_stiffness", 40, 150)};
    tether.damping = draws.between("rope_damping", 0.0, 10.0);
    tether.anchor.z() = handle_height + tether.length + pull / tether.stiffness;
    scenario.tether = tether;
    scenario.forces.clear();
    scenario.end.duration = std::min(scenario.end.duration, 10.0);
  }
  if (draws.happens("drives", 0.5)) {
    scenario.guides.clear();
    scenario.perturbation.drive = RandomDrive{.velocity = draws.between("velocity", 0.1, 0.5),
                                              .yaw_rate = draws.between("yaw_rate", 0.0, 0.5)};
  }
  return scenario;
}

Scenario draw_rockings(const Draws& draws) {
  Scenario scenario;
  scenario.guides = {hands().back()};  // at the wheels, so that the torso tilts
  scenario.forces_for_mass = written_mass;
  double time = draws.between("start", 1.0, 2.0);
  const int count = draws.whole("count", 4, 10);
  double side = draws.happens("left", 0.5) ? 1.0 : -1.0;
  for (int i = 0; i < count; ++i) {
    const Draws rock = draws.of("rock", i);
    // A couple about the heading: tipping over a wheel takes 8 N·m with Upkie's track.
    policies::TimedForce force{.time = time, .duration = rock.between("duration", 0.1, 0.35)};
    force.rise = force.fall = 0.3 * force.duration;
    force.force.z() = rock.between("force", 22.0, 38.0);
    force.point_in_base = {0.0, 0.2 * side, -0.1};
    scenario.forces.push_back(force);
    force.force.z() *= -1.0;
    force.point_in_base.y() *= -1.0;
    scenario.forces.push_back(force);
    time += force.duration + rock.log_between("pause", 0.1, 1.0);
    side = -side;
  }
  scenario.terrain.friction = draws.between("friction", 0.4, 1.0);
  scenario.end.duration = time + 1.0;
  scenario.perturbation = {.yaw = 0.3, .crouch = 0.15, .mass_scale = 0.1, .force_scale = 0.2};
  return scenario;
}

Scenario draw_put_downs(const Draws& draws) {
  Scenario scenario = lifted(draws, {{0.02, 0.5}, usual_hold, slow_weight});
  scenario.perturbation.drive = RandomDrive{.velocity = draws.between("velocity", 0.2, 0.6),
                                            .yaw_rate = 0.0,
                                            .standing = 0.1,
                                            .hold = {0.5, 1.5},
                                            .start = 0.5};
  return scenario;
}

Scenario draw_hangs(const Draws& draws) {
  constexpr double handle_height = 0.85;  // m above the floor, with the tyres well above it
  Scenario scenario;
  scenario.start.clearance = 0.3;
  policies::Tether tether;
  tether.length = draws.between("rope", 0.6, 1.6);
  tether.anchor.z() = handle_height + tether.length;
  tether.stiffness = draws.log_between("stiffness", 1000.0, 4000.0);
  scenario.tether = tether;
  double time = 1.0;
  for (int i = 0; time < 8.0; ++i) {
    const Draws command = draws.of("command", i);
    scenario.velocity.push_back({.time = time, .velocity = command.between("velocity", -0.5, 0.5)});
    time += command.between("hold", 1.0, 4.0);
  }
  scenario.end.duration = 10.0;
  scenario.perturbation = {.x = 0.15, .y = 0.15, .yaw = 0.5, .crouch = 0.15, .mass_scale = 0.1};
  return scenario;
}

Scenario draw_pushes(const Draws& draws) {
  Scenario scenario;
  scenario.forces_for_mass = written_mass;
  double time = 1.5;
  const int count = draws.whole("count", 3, 6);
  for (int i = 0; i < count; ++i) {
    const Draws push = draws.of("push", i);
    const double angle = push.between("angle", -std::numbers::pi, std::numbers::pi);
    // A push from the side topples the robot, as it cannot step aside.
    const double newtons = push.between("force", 4.0, 14.0);
    scenario.forces.push_back(
        {.time = time,
         .duration = push.between("duration", 0.1, 0.25),
         .force = {newtons * std::cos(angle), 0.6 * newtons * std::sin(angle), 0.0},
         .point_in_base = {0.0, 0.0, push.between("height", -0.2, 0.0)},
         .along_heading = true});
    time += push.between("pause", 1.5, 2.5);
  }
  scenario.terrain.friction = draws.between("friction", 0.4, 1.0);
  scenario.end.duration = time;
  scenario.perturbation = {.yaw = 0.5, .crouch = 0.1, .mass_scale = 0.05, .force_scale = 0.2};
  return scenario;
}

Scenario draw_push_offs(const Draws& draws) {
  constexpr double edge = 0.5;  // m
  Scenario scenario;
  models::Terrain& terrain = scenario.terrain;
  terrain.start_x = -1.5;
  terrain.width = 6.0;
  terrain.friction = draws.between("friction", 0.5, 1.0);
  terrain.pieces = {models::Flat{edge - terrain.start_x},
                    models::Step{draws.between("drop", 0.05, 0.2),
                                 draws.log_between("nosing_radius", 0.003, 0.03)},
                    models::Flat{3.0}};
  scenario.balancer.keep_heading = true;
  const double time = draws.between("departure", 1.0, 2.0);
  scenario.velocity = {{.time = time, .velocity = draws.between("velocity", 0.45, 0.8)}};
  scenario.forces = {{.time = time,
                      .duration = 0.3,
                      .force = {draws.between("force", 8.0, 15.0), 0.0, 0.0},
                      .point_in_base = {0.0, 0.0, -0.1},
                      .along_heading = true}};
  scenario.forces_for_mass = written_mass;
  scenario.start.yaw = draws.between("yaw", -0.6, 0.6);
  scenario.end = {.duration = 12.0, .x = 1.5, .settle = 1.5};
  scenario.perturbation = {.x = 0.1, .y = 0.2, .yaw = 0.1, .velocity = 0.05, .crouch = 0.1};
  return scenario;
}

}  // namespace touchdown::scenarios
