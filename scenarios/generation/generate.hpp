#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/key.hpp"
#include "scenarios/generation/family.hpp"

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

}  // namespace touchdown::scenarios
