#pragma once

#include "scenarios/generation/draws.hpp"
#include "scenarios/scenario.hpp"

/// Families of scenarios on level ground in which only the robot itself acts.
namespace touchdown::scenarios {

Scenario draw_drives(const Draws& draws);  ///< random commands and crouches, always in contact
Scenario draw_squats(const Draws& draws);  ///< legs that bend quickly: the torso falls
Scenario draw_hops(const Draws& draws);    ///< legs that extend quickly: small hops

}  // namespace touchdown::scenarios
