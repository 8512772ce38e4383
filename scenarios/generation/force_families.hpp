#pragma once

#include "scenarios/generation/draws.hpp"
#include "scenarios/scenario.hpp"

/// Families of scenarios in which external forces move the robot. Forces are written for Upkie's
/// mass and scale with another robot's.
namespace touchdown::scenarios {

/// Upkie's mass (kg), for which the forces are written.
inline constexpr double forces_mass = 5.33922;

Scenario draw_lifts(const Draws& draws);       ///< forces that appear and vanish at once
Scenario draw_slow_lifts(const Draws& draws);  ///< forces that grow and fade over .2 to 10 s
Scenario draw_put_downs(const Draws& draws);   ///< lifted and put down while the wheels spin
Scenario draw_hangs(const Draws& draws);       ///< on a rope, never in contact
Scenario draw_pushes(const Draws& draws);      ///< pushed while it stands, from all sides
Scenario draw_push_offs(const Draws& draws);   ///< pushed over the edge of a platform

}  // namespace touchdown::scenarios
