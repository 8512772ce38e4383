#pragma once

#include <string>
#include <vector>

#include "scenarios/generation/draws.hpp"
#include "scenarios/scenario.hpp"

namespace touchdown::scenarios {

/// One kind of generated scenario. A new family is a function and a line in families.cpp.
struct Family {
  std::string name;     ///< in experiments and file names
  std::string summary;  ///< one sentence
  /// Draws one scenario. What it leaves at its default is the robot's own or the engine's.
  Scenario (*draw)(const Draws& draws);
};

/// All families, in the order in which `generate` takes turns.
const std::vector<Family>& families();

/// Errors: `InputError` for an unknown family, with the nearest one.
const Family& family_called(const std::string& name);

}  // namespace touchdown::scenarios
