#include <algorithm>
#include <string>

#include "core/fields.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/config/experiment_yaml.hpp"
#include "experiments/config/yaml_kind.hpp"
#include "models/robot_description.hpp"
#include "scenarios/scenario.hpp"
#include "tests/fuzz/entry.hpp"

namespace touchdown::fuzz {

/// An experiment file, read, written and read again.
TOUCHDOWN_FUZZ(yaml_experiment) {
  const YamlDocument document = experiments::completed(
      YamlDocument::parse(std::string(input), "fuzz.yaml"), experiments::YamlKind::experiment);
  const std::string written = to_yaml(experiments::experiment_from_yaml(document));
  (void)experiments::experiment_from_yaml(YamlDocument::parse(written, "again.yaml"));
}

/// A robot file, without the MJCF that it names.
TOUCHDOWN_FUZZ(yaml_robot) {
  (void)from_yaml<models::RobotDescription>(YamlDocument::parse(std::string(input), "fuzz.yaml"));
}

/// A scenario file, read, written and read again.
TOUCHDOWN_FUZZ(yaml_scenario) {
  const YamlDocument document = YamlDocument::parse(std::string(input), "fuzz.yaml");
  const std::string written = to_yaml(scenarios::scenario_from_yaml(document));
  (void)scenarios::scenario_from_yaml(YamlDocument::parse(written, "again.yaml"));
}

/// Arguments of `--set` for a scenario, one assignment per line.
TOUCHDOWN_FUZZ(yaml_set) {
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
}

}  // namespace touchdown::fuzz
