#pragma once

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <sys/statvfs.h>
#include <system_error>

#include "core/files.hpp"

namespace touchdown {

/// An empty folder for one test, removed with all its content afterwards. Tests run in parallel, so
/// no two may write to the same place.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (parent() / "touchdown_XXXXXX").string();
    const char* made = ::mkdtemp(name.data());
    if (made == nullptr) throw std::filesystem::filesystem_error("mkdtemp", std::error_code());
    path_ = made;
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

  /// Writes a file and returns its path.
  std::filesystem::path write(const std::string& name, const std::string& content) const {
    write_atomically(path_ / name, content);
    return path_ / name;
  }

 private:
  /// In memory, where tests do not wait for a disk, unless it is small or no place for programs.
  static std::filesystem::path parent() {
    const char* const memory = "/dev/shm";
    struct statvfs status = {};
    const bool is_usable = std::getenv("TMPDIR") == nullptr && ::statvfs(memory, &status) == 0 &&
                           (status.f_flag & ST_NOEXEC) == 0 &&
                           status.f_bavail >= (std::uint64_t{2} << 30U) / status.f_frsize;
    return is_usable ? memory : std::filesystem::temp_directory_path();
  }

  std::filesystem::path path_;
};

/// Lets temporary files be in another folder while it exists.
class TemporaryFilesIn {
 public:
  explicit TemporaryFilesIn(const std::filesystem::path& folder) {
    if (const char* const before = std::getenv("TMPDIR"); before != nullptr) before_ = before;
    ::setenv("TMPDIR", folder.c_str(), 1);
  }
  TemporaryFilesIn(const TemporaryFilesIn&) = delete;
  TemporaryFilesIn& operator=(const TemporaryFilesIn&) = delete;
  ~TemporaryFilesIn() { before_ ? ::setenv("TMPDIR", before_->c_str(), 1) : ::unsetenv("TMPDIR"); }

 private:
  std::optional<std::string> before_;
};

}  // namespace touchdown
