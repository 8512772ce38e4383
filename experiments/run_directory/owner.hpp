#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

namespace touchdown::experiments {

/// Where a run writes: these files and folders of its directory, nothing else.
inline constexpr std::array run_files = {"config.yaml", "manifest.json", "report.html"};
inline constexpr std::array run_folders = {"state",  "recordings", "models",
                                           "tables", "figures",    "videos"};

/// The experiment that a run directory belongs to.
struct RunDirectoryOwner {
  std::string key;      ///< the whole of it, `key_of`; empty where only the manifest says so
  std::string request;  ///< the experiment's digest
  std::string name;     ///< of the experiment; empty if its file cannot be read
};

/// Where a run directory says whose it is.
std::filesystem::path key_file(const std::filesystem::path& directory);

/// What it says there: a request, and the build that computes it.
std::string key_of(const std::string& request, const std::string& build);

/// Nothing if the directory is nobody's.
std::optional<RunDirectoryOwner> owner_of(const std::filesystem::path& directory);

/// Where something else than an experiment goes, with its `config.yaml`. Errors: `InputError` when
/// the directory is an experiment's, or when there is another `config.yaml` without the `result`
/// that such leave: it is somebody's own.
void require_place_beside(const std::filesystem::path& directory, const std::string& config,
                          const std::filesystem::path& result);

/// Errors: `InputError`, naming it, when a directory that is nobody's, and does not become a run's
/// meanwhile, holds something where a run would write: it is not a run's to replace.
void require_no_untracked_files(const std::filesystem::path& directory);

}  // namespace touchdown::experiments
