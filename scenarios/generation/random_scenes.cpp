#include <algorithm>
#include <array>
#include <vector>

#include "scenarios/generation/families.hpp"

namespace touchdown::scenarios {

namespace {

constexpr double duration = 14.0;  // s
constexpr double rounding = 1e-4;  // m: files round heights, and no ground may be below the floor
constexpr double weight = written_mass * scene_gravity;

/// Any piece that wheels can pass: drops, slopes both ways, fronts of up to 2 cm. `height` (m) is
/// that of its end above the floor, then of its beginning, which is no lower than the floor.
models::TerrainPiece any_piece(const Draws& draws, double& height) {
  const auto nosing = [&](double edge) {
    return std::min(0.5 * edge, draws.log_between("nosing_radius", 0.002, 0.04));
  };
  switch (draws.whole("kind", 0, 4)) {
    case 0: {
      const double drop = draws.log_between("drop", 0.01, 0.25);
      height += drop;
      return models::Step{drop, nosing(drop)};
    }
    case 1: {
      const double front = draws.log_between("height", 0.003, 0.02);
      return models::Platform{draws.log_between("length", 0.05, 1.0), front, nosing(front)};
    }
    case 2:
    case 3: {
      double rise = draws.between("rise", -0.15, 0.15);
      if (rise > height - rounding) rise = -rise;
      height -= rise;
      return models::Ramp{draws.between("incline", 2.0, 15.0), rise};
    }
    default:
      return models::Flat{draws.log_between("flat", 0.05, 1.5)};
  }
}

/// Such pieces with level ground between, so that every edge has room.
std::vector<models::TerrainPiece> any_pieces(const Draws& draws) {
  std::vector<models::TerrainPiece> pieces;
  double height = 0.0;
  const int count = draws.whole("count", 3, 12);
  for (int i = 0; i < count; ++i) {
    const Draws piece = draws.of("piece", i);
    pieces.emplace_back(models::Flat{piece.log_between("after", 0.06, 0.6)});
    pieces.push_back(any_piece(piece, height));
  }
  // A lane begins at the floor.
  if (height > 0.001) {
    pieces.emplace_back(models::Ramp{draws.between("incline", 4.0, 12.0), height - rounding});
  }
  std::reverse(pieces.begin(), pieces.end());
  return pieces;
}

void draw_terrain(const Draws& draws, models::Terrain& terrain) {
  terrain.friction = draws.between("friction", 0.3, 1.0);
  if (draws.happens("level", 0.25)) return;
  terrain.start_x = 0.8;
  if (draws.happens("both_wheels", 0.5)) {
    terrain.width = 4.0;
    terrain.pieces = any_pieces(draws.of("middle", 0));
    return;
  }
  const std::array sides = {0.6, -0.6};
  const int only = draws.whole("only", -1, 1);  // −1: a lane of its own under each wheel
  for (int side = 0; side < 2; ++side) {
    if (only == 1 - side) continue;
    terrain.beside.push_back({.pieces = any_pieces(draws.of("lane", side)),
                              .start_x = terrain.start_x,
                              .y = sides[static_cast<std::size_t>(side)],
                              .width = 1.1});
  }
}

/// Commands at random times: driving, turning, and legs that bend and extend at any rate.
void draw_commands(const Draws& draws, Scenario& scenario) {
  const double fastest = draws.between("fastest", 0.1, 0.9);
  const double fastest_turn = std::max(0.0, draws.between("fastest_turn", -0.3, 0.6));
  double time = 0.7;
  for (int i = 0; time < duration; ++i) {
    const Draws command = draws.of("velocity", i);
    // Ahead, where the terrain is.
    scenario.velocity.push_back(
        {.time = time,
         .velocity = command.between("velocity", 0.0, 1.0) * fastest,
         .yaw_rate = command.between("yaw_rate", -fastest_turn, fastest_turn)});
    time += command.log_between("hold", 0.4, 6.0);
  }
  scenario.clip_crouches = true;
  if (draws.happens("legs_stay", 0.3)) return;
  const double fastest_motion = draws.log_between("fastest_motion", 0.5, 9.0);
  time = 1.0;
  for (int i = 0; time < duration; ++i) {
    const Draws command = draws.of("crouch", i);
    scenario.crouch.push_back({.time = time,
                               .hip = command.between("hip", 0.15, 0.85),
                               .rate = command.log_between("rate", 0.2, fastest_motion)});
    time += command.log_between("hold", 0.1, 3.0);
  }
}

/// Forces that overlap, in any direction, and sometimes a rope, stiff or soft.
void draw_forces(const Draws& draws, Scenario& scenario) {
  const int count = std::max(0, draws.whole("count", -2, 5));
  for (int i = 0; i < count; ++i) {
    const Draws push = draws.of("force", i);
    policies::TimedForce force{.time = push.between("time", 1.0, duration)};
    force.rise = push.log_between("rise", 0.005, 2.0);
    force.fall = push.log_between("fall", 0.005, 2.0);
    force.duration = force.rise + push.log_between("hold", 0.05, 4.0) + force.fall;
    force.force = {push.between("ahead", -8.0, 8.0), push.between("aside", -5.0, 5.0),
                   push.between("up", -0.4, 1.08) * weight};
    force.point_in_base = {push.between("x", -0.05, 0.05), push.between("y", -0.1, 0.1),
                           push.between("z", -0.1, 0.1)};
    force.along_heading = true;
    scenario.forces.push_back(force);
  }
  if (draws.happens("held", 0.15)) {
    scenario.guides = {{.stiffness = draws.log_between("guide", 50.0, 400.0), .damping = 40.0}};
  }
  if (draws.happens("rope", 0.12)) {
    policies::Tether rope{.stiffness = draws.log_between("rope_stiffness", 50.0, 2000.0)};
    rope.damping = draws.log_between("rope_damping", 1.0, 50.0);
    rope.anchor.z() =
        0.55 + rope.length + draws.between("pull", 0.1, 1.2) * weight / rope.stiffness;
    scenario.tether = rope;
    for (policies::VelocityCommand& command : scenario.velocity) command.velocity *= 0.2;
  }
}

}  // namespace

Scenario draw_random_scene(const Draws& draws) {
  Scenario scenario;
  draw_terrain(draws.of("terrain", 0), scenario.terrain);
  draw_commands(draws.of("commands", 0), scenario);
  draw_forces(draws.of("forces", 0), scenario);
  scenario.forces_for_mass = written_mass;
  if (draws.happens("payload", 0.3)) {
    scenario.deviations.payload = draws.between("kilograms", 0.0, 3.0);
  }
  if (draws.happens("tyre", 0.3)) {
    const double stiffness = draws.log_between("stiffness", 8e3, 1e5);
    scenario.tyre = spring_tyre(stiffness, draws.between("damping_ratio", 0.12, 0.8));
  }
  scenario.end.duration = duration;
  scenario.perturbation = {.yaw = 0.3, .crouch = 0.3, .mass_scale = 0.15, .servo_gain_scale = 0.2};
  return scenario;
}

}  // namespace touchdown::scenarios
