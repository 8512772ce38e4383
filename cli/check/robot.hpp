#pragma once

#include <cstddef>
#include <string>

#include "cli/verbs.hpp"

namespace touchdown::cli {

/// Whether a file describes a robot, by its extension: .xml, .urdf, .yaml, .yml.
bool is_robot_file(const std::string& path);

/// Checks one robot and prints what was read, what is ignored and how it stands, as text or as
/// JSON. Returns the number of complaints. Errors: `Stopped`.
std::size_t check_robot(const std::string& path, bool as_json, const CliSession& session);

}  // namespace touchdown::cli
