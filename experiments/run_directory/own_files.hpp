#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace touchdown::experiments {

/// The files in a run directory that its runs made, known by the names that the directory's own
/// experiment gives them, but for its key and its lock. `config.yaml`, from which most names
/// follow, is the last. What else lies there is somebody's own, and so is what links lead to.
std::vector<std::filesystem::path> own_files(const std::filesystem::path& directory);

/// Removes them, and folders that are empty then.
void remove_own_files(const std::filesystem::path& directory);

/// What lies in a run directory and was made by no run.
struct UntrackedFiles {
  std::size_t files = 0;
  std::uintmax_t bytes = 0;
};

/// Removes a whole run directory with key, lock and the logs of a cluster. UntrackedFiles stay, and then
/// the directory does.
UntrackedFiles remove_run(const std::filesystem::path& directory);

/// Removes what processes that were killed left half written where a run writes: files and folders
/// with the names that such have, and nothing of anybody who is still writing: to be called by who
/// has the directory alone.
void remove_partial_files(const std::filesystem::path& directory);

}  // namespace touchdown::experiments
