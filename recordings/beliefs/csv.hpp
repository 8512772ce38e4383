#pragma once

#include <filesystem>

#include "recordings/beliefs/beliefs.hpp"

namespace touchdown::recordings {

/// Reads beliefs as comma-separated values: a line of names, then a line per step. Decisions are 1
/// and 0 or true and false. Errors: `InputError` with file:line:column.
Beliefs read_belief_csv(const std::filesystem::path& path);

}  // namespace touchdown::recordings
