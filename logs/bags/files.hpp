#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <string>

namespace touchdown::logs {

/// A file that is read at any position.
class RandomFile {
 public:
  /// `name` is for messages; `stop` may be null. Errors: `InputError` when the file does not exist
  /// or cannot be opened.
  RandomFile(const std::filesystem::path& path, std::string name,
             const std::atomic<bool>* stop = nullptr);
  RandomFile(const RandomFile&) = delete;
  RandomFile& operator=(const RandomFile&) = delete;
  ~RandomFile();

  const std::string& name() const { return name_; }
  std::uint64_t size() const { return size_; }

  /// Replaces `bytes` by those in [offset, offset + size), or fewer at the end of the file. Errors:
  /// `Error` when they cannot be read; `Stopped` once `stop` is true.
  void read(std::uint64_t offset, std::uint64_t size, std::string& bytes) const;

 private:
  std::string name_;
  const std::atomic<bool>* stop_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace touchdown::logs
