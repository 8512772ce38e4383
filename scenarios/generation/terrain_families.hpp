#pragma once

#include "scenarios/generation/draws.hpp"
#include "scenarios/scenario.hpp"

/// Families of scenarios in which the terrain causes the flights.
namespace touchdown::scenarios {

Scenario draw_stairs(const Draws& draws);      ///< down a flight of stairs
Scenario draw_kerbs(const Draws& draws);       ///< up a ramp and off its end with one wheel
Scenario draw_ridges(const Draws& draws);      ///< along a washboard, with both wheels or one
Scenario draw_ramps(const Draws& draws);       ///< up a ramp, along a top, down a step or a ramp
Scenario draw_ramp_jumps(const Draws& draws);  ///< up a ramp and off its end at speed
Scenario draw_courses(const Draws& draws);     ///< several of these pieces in a row

}  // namespace touchdown::scenarios
