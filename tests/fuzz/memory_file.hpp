#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

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

/// A `.npz` of the arrays in the input. Each is a byte that chooses one of `names`, two bytes with
/// the size (little endian), and that many bytes of a `.npy`. Sizes and checksums of the archive
/// are valid, so only the arrays are fuzzed.
std::string archive_of(std::string_view input, const std::vector<std::string>& names);

}  // namespace touchdown::fuzz
