#include <string>

#include "core/error.hpp"
#include "scenarios/scenario.hpp"
#include "tests/fuzz/entry.hpp"

namespace touchdown::fuzz {

/// A scenario file, read, written and read again.
TOUCHDOWN_FUZZ(yaml_scenario) {
  try {
    const YamlDocument document = YamlDocument::parse(std::string(input), "fuzz.yaml");
    const std::string written = to_yaml(scenarios::scenario_from_yaml(document));
    (void)scenarios::scenario_from_yaml(YamlDocument::parse(written, "again.yaml"));
  } catch (const Error& error) {
    expected(error, input);
  }
}

}  // namespace touchdown::fuzz
