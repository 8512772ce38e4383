#pragma once

#include "core/yaml.hpp"

namespace touchdown::experiments {

/// The three kinds of YAML file a user hands to the program; each has a verb of its own.
enum class YamlKind { experiment, scenario, training };

/// Errors: `InputError` when the document is plainly of another kind than `wanted`; it says which
/// verb takes it. A document that is of no known kind passes: its reader knows better what to say.
void require_yaml_kind(const YamlDocument& document, YamlKind wanted);

}  // namespace touchdown::experiments
