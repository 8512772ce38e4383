#include <string>

#include "core/error.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/config/yaml_kind.hpp"
#include "experiments/studies/experiment_file.hpp"
#include "tests/fuzz/entry.hpp"

namespace touchdown::fuzz {

/// An experiment file, read, written and read again.
TOUCHDOWN_FUZZ(yaml_experiment) {
  try {
    const YamlDocument document = YamlDocument::parse(std::string(input), "fuzz.yaml");
    experiments::require_yaml_kind(document, experiments::YamlKind::experiment);
    const std::string written = to_yaml(experiments::experiment_from_yaml(document));
    (void)experiments::experiment_from_yaml(YamlDocument::parse(written, "again.yaml"));
  } catch (const Error& error) {
    expected(error, input);
  }
}

}  // namespace touchdown::fuzz
