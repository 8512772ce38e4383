#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/columns.hpp"

namespace touchdown::experiments {

/// Saves what the columns of `tables/<table>` mean, in `state/columns` of a run directory. The
/// table itself has only their names.
void write_columns(const std::filesystem::path& run_directory, std::string_view table,
                   const std::vector<ColumnInfo>& columns);

/// The columns of a table; empty if they are not saved.
std::vector<ColumnInfo> read_columns(const std::filesystem::path& run_directory,
                                     std::string_view table);

/// The file names of all tables with saved columns, sorted.
std::vector<std::string> tables_with_columns(const std::filesystem::path& run_directory);

}  // namespace touchdown::experiments
