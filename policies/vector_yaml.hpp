#pragma once

#include <string_view>

#include <Eigen/Core>

#include "core/fields.hpp"

namespace touchdown::policies {

/// A point or force as a list of three numbers.
void describe_vector(Fields& fields, std::string_view key, Eigen::Vector3d& value);

}  // namespace touchdown::policies
