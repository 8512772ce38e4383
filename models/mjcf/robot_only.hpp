#pragma once

#include <string>
#include <vector>

#include "models/mjcf/document.hpp"

namespace touchdown::models {

/// Reduces an MJCF to its robot. Solver options, sizes, cameras, sensors, keyframes, contact pairs
/// and a floor are removed: the scene has its own, or does without. Returns one sentence for each
/// kind of thing that was removed, with its place.
/// Errors: `InputError` with file:line:1 for everything that changes the physics and that not every
/// engine is given: other gravity, air, disabled contacts, tendons, equality constraints, obstacles
/// and other bodies, composite bodies, a floor of heights, or more than 5,000 geoms.
std::vector<std::string> keep_robot_only(MjcfDocument& document);

}  // namespace touchdown::models
