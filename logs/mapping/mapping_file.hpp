#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "core/key.hpp"
#include "logs/mapping/mapping.hpp"

namespace touchdown::logs {

/// Reads a mapping file for a log with these names; a log with several sources has several. Contact
/// labels may be left out, as a robot's loop has none. Errors:
/// `InputError` with file:line:column for
/// - an unknown or missing key;
/// - a name that the log lacks, or a column that is used twice;
/// - a wrong number of names, signs or units.
LogMapping read_log_mapping(const std::filesystem::path& path, std::span<const SourceNames> sources,
                            bool with_labels = true);

/// The keys of a mapping file.
std::vector<Key> mapping_keys();

}  // namespace touchdown::logs
