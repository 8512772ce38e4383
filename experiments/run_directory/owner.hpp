#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

namespace touchdown::experiments {

/// The files and folders of its directory that a run writes to.
inline constexpr std::array run_files = {"config.yaml", "manifest.json", "report.html"};
inline constexpr std::array run_folders = {"state",  "recordings", "models",
                                           "tables", "figures",    "videos"};

/// The experiment that a run directory belongs to.
struct RunDirectoryOwner {
  std::string key;      ///< `key_of`; empty if only the manifest names the owner
  std::string request;  ///< the experiment's digest
  std::string name;     ///< of the experiment; empty if its file cannot be read
};

/// The file that names the owner of a run directory.
std::filesystem::path key_file(const std::filesystem::path& directory);

/// The content of that file: a request, and the build that computes it.
std::string key_of(const std::string& request, const std::string& build);

/// The owner of a run directory; nothing if it has none.
std::optional<RunDirectoryOwner> owner_of(const std::filesystem::path& directory);

/// Checks a directory for a program other than an experiment, which writes a `config.yaml` with
/// this content. Errors: `InputError` when an experiment owns the directory. Also when it has a
/// different `config.yaml` but no `result`: then the user made that file.
void require_place_beside(const std::filesystem::path& directory, const std::string& config,
                          const std::filesystem::path& result);

/// Refuses to overwrite untracked files. Errors: `InputError` that names a file in a place that a
/// run writes to, if the directory has no owner and no run takes it meanwhile.
void require_no_untracked_files(const std::filesystem::path& directory);

}  // namespace touchdown::experiments
