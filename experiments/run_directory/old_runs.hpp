#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace touchdown::experiments {

/// A run directory that is not its experiment's latest.
struct OldRun {
  std::filesystem::path directory;
  std::uintmax_t bytes = 0;  ///< of all files in it
};

/// The run directories `runs/<experiment>/<id>`, sorted by name, except those that `latest` points
/// to. Experiments without a `latest` and folders without a `config.yaml` are skipped.
/// Errors: `InputError` when `runs` is no directory.
std::vector<OldRun> old_runs(const std::filesystem::path& runs);

}  // namespace touchdown::experiments
