#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>

namespace touchdown::experiments {

/// How a process uses a run directory: alone, or shared with others.
enum class Access { alone, shared };

/// A lock on a run directory, held for as long as this lives and the process runs. It is a system
/// lock on the file `state/lock`, so a killed process leaves no stale lock. The file names the
/// holders.
class DirectoryLock {
 public:
  /// Locks an existing directory for as long as any copy lives; waits up to `patience` for other
  /// processes. `command` is the command line. On a file system without locks it holds none.
  /// Errors: `Error` that names the holder.
  DirectoryLock(const std::filesystem::path& directory, Access access, const std::string& command,
                std::chrono::milliseconds patience = {});

  /// A shared lock for commands that only read a run's files: creates no file. Holds nothing if
  /// there is no lock file, or it cannot be opened.
  static DirectoryLock for_reading(const std::filesystem::path& directory,
                                   const std::string& command);

  /// Whether the locked directory is still at its path: others may move or remove it.
  [[nodiscard]] bool is_in_place() const;

 private:
  DirectoryLock() = default;

  std::filesystem::path file_;
  std::shared_ptr<const int> descriptor_;  ///< closes itself
};

/// The lock file, which other code must leave alone.
std::filesystem::path lock_file(const std::filesystem::path& directory);

}  // namespace touchdown::experiments
