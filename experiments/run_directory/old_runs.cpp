#include "experiments/run_directory/old_runs.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.hpp"

namespace touchdown::experiments {

namespace {

namespace fs = std::filesystem;

std::uintmax_t size_of(const fs::path& directory) {
  std::uintmax_t bytes = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(directory)) {
    if (entry.is_regular_file() && !entry.is_symlink()) bytes += entry.file_size();
  }
  return bytes;
}

void add_old_runs_of(const fs::path& experiment, std::vector<OldRun>& found) {
  std::error_code none;
  const fs::path latest = fs::canonical(experiment / "latest", none);
  if (none) return;
  for (const fs::directory_entry& entry : fs::directory_iterator(experiment)) {
    const bool is_run = entry.is_directory() && !entry.is_symlink() &&
                        fs::is_regular_file(entry.path() / "config.yaml");
    if (is_run && fs::canonical(entry.path()) != latest) {
      found.push_back({entry.path(), size_of(entry.path())});
    }
  }
}

}  // namespace

std::vector<OldRun> old_runs(const fs::path& runs) {
  if (!fs::is_directory(runs)) {
    throw InputError(fmt::format("{}: expected a folder of runs", runs.string()));
  }
  std::vector<OldRun> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(runs)) {
    if (entry.is_directory() && !entry.is_symlink()) add_old_runs_of(entry.path(), found);
  }
  std::sort(found.begin(), found.end(),
            [](const OldRun& a, const OldRun& b) { return a.directory < b.directory; });
  return found;
}

}  // namespace touchdown::experiments
