#pragma once

#include <optional>

#include "core/yaml.hpp"
#include "experiments/experiment.hpp"

namespace touchdown {

/// The sections `detail` and `posterior` of an experiment file: which drop is drawn, through which
/// noise. Nothing where a section is absent or
/// says `enabled: false`; an empty one means its defaults. They are read after
/// everything else of the experiment. Errors: `InputError` with file:line:column.
std::optional<DetailConfig> detail_from_yaml(YamlMap& parent, const Experiment& experiment);
std::optional<PosteriorConfig> posterior_from_yaml(YamlMap& parent, const Experiment& experiment);

YAML::Node to_node(const DetailConfig& detail);
YAML::Node to_node(const PosteriorConfig& posterior);

}  // namespace touchdown
