#include "experiments/run_directory/table_columns.hpp"

#include <algorithm>
#include <array>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/table.hpp"

namespace touchdown::experiments {

namespace fs = std::filesystem;

namespace {

/// In the order of `ColumnRole`.
constexpr std::array<std::string_view, 4> role_names = {"key", "metric", "runs", "note"};

ColumnRole role_from(std::string_view text) {
  const auto name = std::find(role_names.begin(), role_names.end(), text);
  if (name == role_names.end()) throw Error("state/columns: a role is unknown");
  return static_cast<ColumnRole>(name - role_names.begin());
}

Columns<ColumnInfo> columns_of_columns() {
  return Columns<ColumnInfo>()
      .text("column", &ColumnInfo::name)
      .text("role",
            [](const ColumnInfo& column) {
              return role_names.at(static_cast<std::size_t>(column.role));
            })
      .text("as", &ColumnInfo::as)
      .flag("has_bounds", &ColumnInfo::has_bounds);
}

fs::path folder_in(const fs::path& run_directory) { return run_directory / "state" / "columns"; }

}  // namespace

void write_columns(const fs::path& run_directory, std::string_view table,
                   const std::vector<ColumnInfo>& columns) {
  write_atomically(folder_in(run_directory) / table, to_csv(columns_of_columns().table(columns)));
}

std::vector<ColumnInfo> read_columns(const fs::path& run_directory, std::string_view table) {
  const fs::path file = folder_in(run_directory) / table;
  std::error_code ignored;
  std::vector<ColumnInfo> columns;
  if (!fs::is_regular_file(file, ignored)) return columns;
  const Table saved = from_csv(read_file(file));
  for (const std::vector<std::string>& row : saved.rows) {
    columns.push_back({cell(saved, row, "column"), role_from(cell(saved, row, "role")),
                       cell(saved, row, "as"), cell(saved, row, "has_bounds") == "1"});
  }
  return columns;
}

std::vector<std::string> tables_with_columns(const fs::path& run_directory) {
  std::vector<std::string> names;
  for (const fs::path& entry : entries_in(folder_in(run_directory))) {
    const std::string name = entry.filename().string();
    if (name.ends_with(".csv") && !name.starts_with('.')) names.push_back(name);
  }
  return names;
}

}  // namespace touchdown::experiments
