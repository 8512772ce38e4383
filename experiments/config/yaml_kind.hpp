#pragma once

#include "core/yaml.hpp"

namespace touchdown::experiments {

/// The three kinds of YAML files that users write. Each kind has its own verb.
enum class YamlKind { experiment, scenario, training };

/// Errors: `InputError`, with the right verb, when the document is clearly of another kind than
/// `wanted`. A document of no known kind passes, because its reader reports a better error.
void require_yaml_kind(const YamlDocument& document, YamlKind wanted);

}  // namespace touchdown::experiments
