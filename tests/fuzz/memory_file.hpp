#pragma once

#include <filesystem>
#include <string_view>

namespace touchdown::fuzz {

/// A file in memory.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view content = {});
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile();

  std::filesystem::path path() const;
  /// Replaces the content, without a new file.
  void set_content(std::string_view content);

 private:
  int descriptor_;
};

}  // namespace touchdown::fuzz
