#include "scenarios/generation/rules.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace touchdown::scenarios {

namespace {

constexpr double highest_lift = 0.8;  // m: higher than that a hand does not carry a robot
constexpr double longest_run = 90.0;  // s

/// How far a robot flies that leaves the end of a ramp at this velocity (m).
double flight_length(const models::Ramp& ramp, double velocity) {
  const double angle = ramp.incline * std::numbers::pi / 180.0;
  const double up = velocity * std::sin(angle);
  const double time = (up + std::sqrt(up * up + 2.0 * scene_gravity * ramp.rise)) / scene_gravity;
  return velocity * std::cos(angle) * time;
}

/// Whether a jump off a ramp ends behind the level ground that follows it.
bool overshoots(const Scenario& scenario) {
  const std::vector<models::TerrainPiece>& pieces = scenario.terrain.pieces;
  const double velocity = scenario.velocity.empty() ? 0.0 : scenario.velocity.back().velocity;
  for (std::size_t i = 0; i + 2 < pieces.size(); ++i) {
    const auto* ramp = std::get_if<models::Ramp>(&pieces[i]);
    const auto* step = std::get_if<models::Step>(&pieces[i + 1]);
    const auto* landing = std::get_if<models::Flat>(&pieces[i + 2]);
    constexpr double room = 0.5;  // m: to come to rest on the wheels before the next piece
    if (ramp && step && landing && ramp->rise > 0.0 &&
        flight_length(*ramp, velocity) + room > landing->length) {
      return true;
    }
  }
  return false;
}

}  // namespace

double greatest_height(const policies::ForceScript& forces, double mass, double duration) {
  constexpr double step = 1e-3;  // s
  double height = 0.0;
  double velocity = 0.0;
  double greatest = 0.0;
  for (double time = 0.0; time < duration; time += step) {
    double up = -mass * scene_gravity;
    for (const policies::TimedForce& force : forces) up += force.share_at(time) * force.force.z();
    velocity += step * up / mass;
    height += step * velocity;
    if (height <= 0.0) height = velocity = 0.0;
    greatest = std::max(greatest, height);
  }
  return greatest;
}

std::optional<std::string> objection_to(const Scenario& scenario) {
  if (scenario.end.duration > longest_run) {
    return fmt::format("it lasts {:.0f} s, more than {:.0f}", scenario.end.duration, longest_run);
  }
  if (scenario.forces_for_mass) {
    const double mass = *scenario.forces_for_mass * scenario.mass_scale;
    const double height = greatest_height(scenario.forces, mass, scenario.end.duration);
    if (height > highest_lift) {
      return fmt::format("it lifts the robot by {:.2f} m, more than {}", height, highest_lift);
    }
  }
  if (overshoots(scenario)) return "a jump ends behind the level ground that follows it";
  return std::nullopt;
}

}  // namespace touchdown::scenarios
