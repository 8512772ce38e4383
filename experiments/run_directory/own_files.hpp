#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace touchdown::experiments {

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

/// Files that runs made, whichever their names: a run records each of them in the journal
/// `state/files` of its directory. So files of any study can be removed with their run, and other
/// files stay.

/// Records a file before it is written, so that no interrupted write leaves an unknown file.
/// Returns its path. `name` is relative to the run directory. Errors: `Error` when the journal
/// cannot be written.
std::filesystem::path record_file(const std::filesystem::path& run_directory,
                                  const std::filesystem::path& name);

/// The recorded files in a run directory that exist, without its key and its lock. `config.yaml`,
/// which names the experiment, and the journal come last. Other files, and those behind links, are
/// not included.
std::vector<std::filesystem::path> own_files(const std::filesystem::path& directory);

/// Errors: `InputError` that names the link, if a link stands for one of the run's own folders:
/// the run would write, and replace files, outside its directory. Also for a directory of an
/// earlier version, which has no journal.
void require_no_links(const std::filesystem::path& directory);

/// Removes these files, and folders that are empty afterwards.
void remove_own_files(const std::filesystem::path& directory);

/// Removes half-written files and folders of killed processes, by their names, where a run writes.
/// The caller must hold the directory alone, so that no other process is still writing them.
void remove_partial_files(const std::filesystem::path& directory);

}  // namespace touchdown::experiments
