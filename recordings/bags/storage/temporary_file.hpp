#pragma once

#include <filesystem>

namespace touchdown::recordings {

/// An empty file of its own name in the folder for temporary files, which the destructor deletes.
/// Errors: `Error` when it cannot be made.
class TemporaryFile {
 public:
  TemporaryFile();
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace touchdown::recordings
