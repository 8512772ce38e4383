#include "experiments/run_directory/old_runs.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"

namespace touchdown::experiments {

namespace {

namespace fs = std::filesystem;

/// Links are not followed.
fs::file_type type_of(const fs::path& path) {
  std::error_code ignored;
  return fs::symlink_status(path, ignored).type();
}

std::uintmax_t size_of(const fs::path& directory) {
  std::uintmax_t bytes = 0;
  for (const fs::path& entry : entries_below(directory)) {
    if (type_of(entry) == fs::file_type::regular) bytes += size_of_file(entry);
  }
  return bytes;
}

void add_old_runs_of(const fs::path& experiment, std::vector<OldRun>& found) {
  std::error_code none;
  const fs::path latest = fs::canonical(experiment / "latest", none);
  if (none) return;
  for (const fs::path& entry : entries_in(experiment)) {
    const bool is_run = type_of(entry) == fs::file_type::directory &&
                        fs::is_regular_file(entry / "config.yaml", none);
    if (is_run && fs::canonical(entry, none) != latest) found.push_back({entry, size_of(entry)});
  }
}

}  // namespace

std::vector<OldRun> old_runs(const fs::path& runs) {
  if (!is_folder(runs)) {
    throw InputError(fmt::format("{}: expected a folder of runs", runs.string()));
  }
  std::vector<OldRun> found;
  for (const fs::path& entry : entries_in(runs)) {
    if (type_of(entry) == fs::file_type::directory) add_old_runs_of(entry, found);
  }
  std::sort(found.begin(), found.end(),
            [](const OldRun& a, const OldRun& b) { return a.directory < b.directory; });
  return found;
}

}  // namespace touchdown::experiments
