#pragma once

#include <optional>
#include <string>

#include "scenarios/scenario.hpp"

namespace touchdown::scenarios {

/// Gravity in every scene (m/s²).
inline constexpr double scene_gravity = 9.81;

/// Why a drawn scenario is rejected; empty if it is kept. The rules look at the scenario alone,
/// never at an estimator or a simulation: a robot that is lifted must not rise out of reach, and a
/// jump must end on the ground that is meant for it.
std::optional<std::string> objection_to(const Scenario& scenario);

/// The greatest height (m) that forces without a controller lift a robot of this mass (kg) to. It
/// leaves the ground when they exceed its weight.
double greatest_height(const policies::ForceScript& forces, double mass, double duration);

}  // namespace touchdown::scenarios
