#pragma once

#include <string>

#include "scenarios/scenario.hpp"

namespace touchdown::scenarios {

/// The number under a dotted key of a scenario, with list items by index:
/// `terrain.pieces.1.stairs.rise`. NaN if there is no such number.
double number_at(const Scenario& scenario, const std::string& key);

/// The scenario with another number under that key. Errors: `InputError` for an unknown key or a
/// number out of range, reported for a scenario file called `name`.
Scenario varied(const Scenario& scenario, const std::string& key, double value,
                const std::string& name);

}  // namespace touchdown::scenarios
