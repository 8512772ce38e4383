#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace touchdown::experiments {

/// The files in a run directory that its runs made, without its key and its lock. They are
/// identified by the names that follow from the directory's own experiment. `config.yaml` comes
/// last, because most names follow from it. Other files, and targets of links, are not included.
std::vector<std::filesystem::path> own_files(const std::filesystem::path& directory);

/// Errors: `InputError` that names the link, if a link stands for one of the run's own folders:
/// the run would write, and replace files, outside its directory.
void require_no_links(const std::filesystem::path& directory);

/// Removes these files, and folders that are empty afterwards.
void remove_own_files(const std::filesystem::path& directory);

/// Files in a run directory that no run made.
struct UntrackedFiles {
  std::size_t files = 0;
  std::uintmax_t bytes = 0;
};

/// Removes a run directory with key, lock and the logs of a cluster. Untracked files stay, and with
/// them the directory.
UntrackedFiles remove_run(const std::filesystem::path& directory);

/// Removes half-written files and folders of killed processes, by their names, where a run writes.
/// The caller must hold the directory alone, so that no other process is still writing them.
void remove_partial_files(const std::filesystem::path& directory);

}  // namespace touchdown::experiments
