#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>

namespace touchdown::experiments {

/// Who may work in a run directory beside whom: one alone, or several who share it.
enum class Access { alone, shared };

/// A run directory that is taken: as long as this lives, and no longer than the process. It is a
/// lock of the system on the file `state/lock`, so that nobody has to clear away what a killed
/// process left; the file says who holds it.
class DirectoryLock {
 public:
  /// Takes a directory that exists, for as long as any copy lives; waits up to `patience` for
  /// others. `command` is what was typed. A disk that knows no locks is worked on without one.
  /// Errors: `Error` that says who is working there.
  DirectoryLock(const std::filesystem::path& directory, Access access, const std::string& command,
                std::chrono::milliseconds patience = {});

  /// The same for somebody who only looks at what a run left there: makes no file. Holds nothing
  /// where there is no lock, or none that may be opened.
  static DirectoryLock for_reading(const std::filesystem::path& directory,
                                   const std::string& command);

 private:
  DirectoryLock() = default;

  std::shared_ptr<const int> descriptor_;  ///< closes itself
};

/// The file, for those who have to leave it alone.
std::filesystem::path lock_file(const std::filesystem::path& directory);

}  // namespace touchdown::experiments
