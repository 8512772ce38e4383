#pragma once

#include <string_view>

#include <Eigen/Core>

#include "core/yaml.hpp"

namespace touchdown {

/// A point or force as a list of three numbers. Errors: `InputError` for any other length.
void read_vector(YamlMap& map, std::string_view key, Eigen::Vector3d& value);
YAML::Node to_node(const Eigen::Vector3d& value);

}  // namespace touchdown
