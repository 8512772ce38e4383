#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/yaml.hpp"

namespace touchdown {

/// Overwrites `names` with a list of different names, each one of `known`, if the key is present.
/// Errors: `InputError` for an empty list, for a name that is unknown (with the nearest one) or
/// stands there twice.
void read_names(YamlMap& map, std::string_view key, const std::vector<std::string>& known,
                std::vector<std::string>& names);

}  // namespace touchdown
