#pragma once

#include <filesystem>
#include <vector>

namespace touchdown::experiments {

/// Files that runs made, whichever their names: a run records each of them in `state/files` of its
/// directory. So tables and films of any study can be removed with their run, and other files stay.

/// Records a file before it is written, so that no interrupted write leaves an unknown file.
/// Returns its path. `name` is relative to the run directory, with at most one folder.
std::filesystem::path record_file(const std::filesystem::path& run_directory,
                                  const std::filesystem::path& name);

/// The recorded files that exist, relative to the run directory, sorted. Links are left out.
std::vector<std::filesystem::path> recorded_files(const std::filesystem::path& run_directory);
}  // namespace touchdown::experiments
