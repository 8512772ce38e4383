#pragma once

#include <string>

#include "scenarios/scenario.hpp"

namespace touchdown::scenarios {

/// The number under a dotted key of a scenario, list items by number:
/// `terrain.pieces.1.stairs.rise`. NaN if there is none.
double number_at(const Scenario& scenario, const std::string& key);

/// The scenario with another number there. Errors: `InputError`, as of the scenario file that is
/// called `name`, for a key that is none and for a number that it refuses.
Scenario varied(const Scenario& scenario, const std::string& key, double value,
                const std::string& name);

}  // namespace touchdown::scenarios
