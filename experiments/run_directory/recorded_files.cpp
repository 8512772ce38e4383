#include "experiments/run_directory/recorded_files.hpp"

#include <algorithm>
#include <string>

#include "core/files.hpp"

namespace touchdown::experiments {

namespace fs = std::filesystem;

namespace {

/// Between folder and name in the name of a record.
constexpr char separator = ':';

fs::path records_in(const fs::path& run_directory) { return run_directory / "state" / "files"; }

std::string record_of(const fs::path& name) {
  std::string record = name.generic_string();
  std::replace(record.begin(), record.end(), '/', separator);
  return record;
}

fs::path name_of(std::string record) {
  const std::size_t end = record.find(separator);
  if (end != std::string::npos) record[end] = '/';
  return record;
}

/// A file that is not reached through a link.
bool is_regular(const fs::path& path) {
  std::error_code ignored;
  return !fs::is_symlink(path.parent_path(), ignored) &&
         fs::symlink_status(path, ignored).type() == fs::file_type::regular;
}

}  // namespace

fs::path record_file(const fs::path& run_directory, const fs::path& name) {
  const fs::path record = records_in(run_directory) / record_of(name);
  if (!is_regular(record)) write_atomically(record, "");
  return run_directory / name;
}

std::vector<fs::path> recorded_files(const fs::path& run_directory) {
  std::vector<fs::path> names;
  for (const fs::path& entry : entries_in(records_in(run_directory))) {
    const std::string record = entry.filename().string();
    const fs::path name = name_of(record);
    // Half-written records begin with a dot. No record leads out of the run directory.
    const bool is_inside = !record.starts_with('.') && !name.filename().string().starts_with('.');
    if (is_inside && is_regular(entry) && is_regular(run_directory / name)) {
      names.push_back(name);
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace touchdown::experiments
