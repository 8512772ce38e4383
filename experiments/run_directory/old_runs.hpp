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

/// The run directories `runs/<experiment>/<id>` but those that `latest` points to, by name. An
/// experiment without a `latest`, and whatever holds no `config.yaml`, is left alone.
/// Errors: `InputError` when `runs` is no directory.
std::vector<OldRun> old_runs(const std::filesystem::path& runs);

}  // namespace touchdown::experiments
