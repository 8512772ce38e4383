#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/key.hpp"
#include "core/yaml.hpp"
#include "scenarios/generation/families.hpp"

namespace touchdown {
class Fields;
}

namespace touchdown::scenarios {

/// Scenarios to draw from a distribution.
struct Generation {
  std::uint64_t seed = 1;
  int count = 1;                           ///< number of scenarios
  std::vector<std::string> families = {};  ///< that take turns; empty: all
};

void describe(Fields& fields, Generation& generation);

/// One drawn scenario.
struct GeneratedScenario {
  std::string name;                   ///< family, seed and number, such as `stairs_7_000`
  std::string family;                 ///< its name
  std::string text;                   ///< of a scenario file that plays alone
  std::vector<std::string> rejected;  ///< why earlier draws of this number were rejected
};

/// Draws scenario `number` of a family: a pure function of its arguments. The file specifies
/// only what the family draws, so that the robot's stance and gains remain its own. Errors: `Error`
/// if a hundred draws in a row are rejected.
GeneratedScenario generate(const Family& family, std::uint64_t seed, std::uint64_t number);

/// Draws all scenarios; families take turns. A longer list begins with the shorter one.
/// `should_continue` is called before each draw. Errors: `InputError` for an unknown family, with
/// the nearest one; `Stopped`.
std::vector<GeneratedScenario> generate(const Generation& generation,
                                        const std::function<bool()>& should_continue = {});

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
