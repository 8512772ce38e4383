#include <algorithm>
#include <string>

#include "core/error.hpp"
#include "scenarios/scenario.hpp"
#include "tests/fuzz/entry.hpp"

namespace touchdown::fuzz {

/// Arguments of `--set` for a scenario, one assignment per line.
TOUCHDOWN_FUZZ(yaml_set) {
  const std::string_view all = input;
  try {
    YamlDocument document = YamlDocument::parse(
        "name: x\nterrain: {pieces: [{flat: {length: 3.0}}]}\nend: {duration: 2.5}\n"
        "velocity: [{time: 0.3, velocity: 0.5}]\nperturbation: {yaw: 0.05}\n",
        "fuzz.yaml");
    while (!input.empty()) {
      const std::string_view line = input.substr(0, input.find('\n'));
      input.remove_prefix(std::min(input.size(), line.size() + 1));
      document.override_value(line);
    }
    (void)to_yaml(scenarios::scenario_from_yaml(document));
  } catch (const Error& error) {
    expected(error, all);
  }
}

}  // namespace touchdown::fuzz
