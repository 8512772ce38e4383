#pragma once

#include <string>
#include <string_view>

#include "core/yaml.hpp"
#include "scenarios/generation/generate.hpp"

namespace touchdown::scenarios {

/// Drawn scenarios have names that stand wherever a scenario file may: `drawn:kerbs_7_000` is
/// number 0 of the family `kerbs` with seed 7.
bool is_drawn(std::string_view name);
std::string drawn_name(const GeneratedScenario& drawn);

/// Draws the scenario with this name. Errors: `InputError` for a name that is none.
GeneratedScenario generate_named(const std::string& name);

/// The text of a scenario file, which `find_resource` finds, or of a drawn scenario.
YamlDocument scenario_document(const std::string& name);

/// That scenario, completed from its robot's file. A non-empty `robot` replaces its own. Errors:
/// `InputError`.
Scenario find_scenario(const std::string& name, const std::string& robot = {});

}  // namespace touchdown::scenarios
