#include <cmath>
#include <numbers>

#include "scenarios/generation/families.hpp"

namespace touchdown::scenarios {

namespace {

using models::Flat;
using models::Ramp;
using models::Step;
using models::TerrainPiece;

constexpr double approach = 1.0;  // m of level ground ahead of the robot
constexpr double behind = 2.0;    // m of level ground behind it
constexpr double degrees = std::numbers::pi / 180.0;
constexpr double room_to_settle = 0.6;  // m after the last edge

double length_of(const Ramp& ramp) {
  return std::abs(ramp.rise) / std::tan(ramp.incline * degrees);
}

/// Drives to x = `finish`; the run lasts twice as long as that takes at the commanded velocity.
void drive_to(Scenario& scenario, const Draws& draws, double finish, double slow, double fast) {
  const double velocity = draws.between("velocity", slow, fast);
  scenario.velocity = {{.time = draws.between("departure", 0.5, 1.5), .velocity = velocity}};
  scenario.end.x = finish;
  scenario.end.duration = 5.0 + 2.0 * finish / velocity;
  scenario.terrain.friction = draws.between("friction", 0.4, 1.0);
  scenario.perturbation.velocity = 0.05;
  scenario.perturbation.y = 0.05;
}

/// Small blocks under one wheel, `y` being the middle of its lane.
models::Strip lane_of_blocks(const Draws& draws, double y, double length) {
  models::Strip lane{.pieces = {}, .start_x = approach, .y = y, .width = 0.6};
  for (double x = 0.0; x < length;) {
    const Draws block = draws.of("block", static_cast<int>(lane.pieces.size()));
    const models::Platform platform{block.log_between("length", 0.03, 0.4),
                                    block.between("height", 0.003, 0.018), 0.003};
    const Flat gap{block.log_between("gap", 0.02, 0.5)};
    lane.pieces.insert(lane.pieces.end(), {platform, gap});
    x += platform.length + gap.length;
  }
  return lane;
}

double nosing(const Draws& draws) { return draws.log_between("nosing_radius", 0.003, 0.03); }

std::vector<TerrainPiece> ridge(const Draws& draws) {
  const Ramp up{draws.between("incline", 9.0, 18.0), draws.between("height", 0.006, 0.014)};
  return {up, Ramp{up.incline, -up.rise}, Flat{draws.between("gap", 0.03, 0.15)}};
}

double length_of_ridge(const std::vector<TerrainPiece>& pieces) {
  return 2.0 * length_of(std::get<Ramp>(pieces[0])) + std::get<Flat>(pieces[2]).length;
}

}  // namespace

Scenario draw_stairs(const Draws& draws) {
  Scenario scenario;
  const models::StairFlight stairs{.count = draws.whole("count", 3, 7),
                                   .run = draws.between("run", 0.6, 1.4),
                                   .rise = draws.between("rise", 0.05, 0.3),
                                   .nosing_radius = nosing(draws)};
  scenario.terrain.pieces = {Flat{behind + approach}, stairs};
  drive_to(scenario, draws, approach + (stairs.count - 1) * stairs.run + room_to_settle, 0.35, 0.8);
  scenario.perturbation.yaw = 0.15;
  return scenario;
}

Scenario draw_kerbs(const Draws& draws) {
  Scenario scenario;
  double x = approach;
  const int count = draws.whole("count", 1, 3);
  for (int i = 0; i < count; ++i) {
    const Draws kerb = draws.of("kerb", i);
    const double height = kerb.between("height", 0.03, 0.09);
    const Ramp up{kerb.between("incline", 4.0, 8.0), height};
    const Flat top{kerb.between("top", 0.2, 0.8)};
    scenario.terrain.beside.push_back({.pieces = {up, top, Step{height, nosing(kerb)}},
                                       .start_x = x,
                                       .y = kerb.happens("left", 0.5) ? 0.6 : -0.6,
                                       .width = 1.1});
    x += length_of(up) + top.length + kerb.between("gap", 0.8, 1.6);
  }
  drive_to(scenario, draws, x + room_to_settle, 0.4, 0.9);
  scenario.perturbation.yaw = 0.08;
  return scenario;
}

Scenario draw_ridges(const Draws& draws) {
  Scenario scenario;
  const std::vector<TerrainPiece> pieces = ridge(draws);
  const int count = draws.whole("count", 8, 20);
  models::Terrain& terrain = scenario.terrain;
  if (draws.happens("one_wheel", 0.4)) {
    terrain.beside = {{.pieces = {models::Repetition{count, pieces}},
                       .start_x = approach,
                       .y = draws.happens("left", 0.5) ? 0.6 : -0.6,
                       .width = 1.1}};
  } else {
    terrain.start_x = approach;
    terrain.pieces = pieces;
    terrain.repeat = count;
  }
  drive_to(scenario, draws, approach + count * length_of_ridge(pieces) + room_to_settle, 0.4, 0.9);
  scenario.perturbation.yaw = 0.15;
  return scenario;
}

Scenario draw_rubble(const Draws& draws) {
  constexpr double length = 4.0;  // m
  Scenario scenario;
  scenario.terrain.beside = {lane_of_blocks(draws.of("lane", 0), 0.3, length),
                             lane_of_blocks(draws.of("lane", 1), -0.3, length)};
  scenario.start.hip = draws.between("hip", 0.4, 0.85);
  scenario.start.knee = policies::knee_per_hip * scenario.start.hip;
  drive_to(scenario, draws, approach + length, 0.25, 0.7);
  scenario.perturbation.yaw = 0.05;
  scenario.perturbation.mass_scale = 0.1;
  return scenario;
}

Scenario draw_ramps(const Draws& draws) {
  Scenario scenario;
  const Ramp up{draws.between("incline", 4.0, 12.0), draws.between("rise", 0.04, 0.15)};
  const Flat top{draws.between("top", 0.3, 1.2)};
  scenario.terrain.pieces = {Flat{behind + approach}, up, top};
  double finish = approach + length_of(up) + top.length;
  if (draws.happens("step_down", 0.6)) {
    scenario.terrain.pieces.emplace_back(Step{up.rise, nosing(draws)});
  } else {
    const Ramp down{draws.between("decline", 4.0, 12.0), -up.rise};
    scenario.terrain.pieces.emplace_back(down);
    finish += length_of(down);
  }
  drive_to(scenario, draws, finish + room_to_settle, 0.5, 1.0);
  scenario.perturbation.yaw = 0.1;
  return scenario;
}

Scenario draw_ramp_jumps(const Draws& draws) {
  Scenario scenario;
  const Ramp up{draws.between("incline", 6.0, 12.0), draws.between("rise", 0.05, 0.12)};
  const Flat landing{draws.between("landing", 1.5, 2.5)};
  const int count = draws.whole("count", 1, 3);
  scenario.terrain.start_x = approach;
  scenario.terrain.pieces = {up, Step{up.rise, nosing(draws)}, landing};
  scenario.terrain.repeat = count;
  drive_to(scenario, draws, approach + count * (length_of(up) + landing.length), 0.8, 1.3);
  scenario.perturbation.yaw = 0.05;
  return scenario;
}

Scenario draw_courses(const Draws& draws) {
  Scenario scenario;
  std::vector<TerrainPiece>& pieces = scenario.terrain.pieces;
  pieces = {Flat{behind + approach}};
  double x = approach;
  const auto add = [&](const TerrainPiece& piece, double length) {
    pieces.push_back(piece);
    x += length;
  };
  const int count = draws.whole("count", 2, 4);
  for (int i = 0; i < count; ++i) {
    const Draws part = draws.of("part", i);
    switch (part.whole("kind", 0, 3)) {
      case 0: {
        const models::StairFlight stairs{.count = part.whole("stairs", 1, 3),
                                         .run = part.between("run", 0.7, 1.2),
                                         .rise = part.between("rise", 0.05, 0.25),
                                         .nosing_radius = nosing(part)};
        add(stairs, stairs.count * stairs.run);
        break;
      }
      case 1: {
        const Ramp up{part.between("incline", 4.0, 10.0), part.between("rise", 0.04, 0.1)};
        const Flat top{part.between("top", 0.3, 0.8)};
        add(up, length_of(up));
        add(top, top.length);
        add(Step{up.rise, nosing(part)}, 0.0);
        break;
      }
      case 2: {
        const std::vector<TerrainPiece> ridges = ridge(part);
        const int repeated = part.whole("ridges", 3, 8);
        add(models::Repetition{repeated, ridges}, repeated * length_of_ridge(ridges));
        break;
      }
      default: {
        const Ramp down{part.between("decline", 4.0, 10.0), -part.between("fall", 0.04, 0.15)};
        add(down, length_of(down));
      }
    }
    const Flat between{part.between("flat", 0.5, 1.2)};
    add(between, between.length);
  }
  drive_to(scenario, draws, x, 0.4, 0.8);
  scenario.perturbation.yaw = 0.1;
  return scenario;
}

}  // namespace touchdown::scenarios
