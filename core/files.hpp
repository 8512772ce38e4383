#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace touchdown {

/// Write a file whole or not at all: `write` fills a temporary file beside `path`, which is renamed
/// over `path` only when `write` returned and the data is on the disk. Missing folders are made.
/// Errors: `Error` when the file cannot be written; whatever `write` throws.
void write_atomically(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path& temporary)>& write);

/// As above, with the whole content at hand.
void write_atomically(const std::filesystem::path& path, std::string_view content);

/// The whole file. Errors: `InputError` when it cannot be read.
std::string read_file(const std::filesystem::path& path);

/// Throws `Error` if no file can be made at `path`: better before an hour of work than after.
void require_writable(const std::filesystem::path& path);

/// A hidden folder beside what is being made, gone afterwards with all that was not moved out of
/// it. Errors: `Error` when it cannot be made.
class PartFolder {
 public:
  explicit PartFolder(const std::filesystem::path& stem);
  ~PartFolder();
  PartFolder(const PartFolder&) = delete;
  PartFolder& operator=(const PartFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace touchdown
