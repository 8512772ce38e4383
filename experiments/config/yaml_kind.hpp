#pragma once

#include <string>
#include <vector>

#include "core/fields.hpp"
#include "core/yaml.hpp"

namespace touchdown::experiments {

/// The kinds of YAML files that users write, but for sensors. Each kind has its own verb.
enum class YamlKind { experiment, scenario, training, robot, mapping };

/// Errors: `InputError`, with the right verb, when the document is clearly of another kind than
/// `wanted`. A document of no known kind passes, because its reader reports a better error.
void require_yaml_kind(const YamlDocument& document, YamlKind wanted);

/// A file of an experiment or a training as it is read: with its base, then with these assignments.
/// Errors: `InputError`, also those of `require_yaml_kind`.
YamlDocument completed(YamlDocument document, YamlKind wanted,
                       const std::vector<std::string>& assignments = {});

/// Describes the key `base` of such files. A completed document has none.
void describe_base(Fields& fields);

}  // namespace touchdown::experiments
