#pragma once

#include <filesystem>
#include <unistd.h>

#include <fmt/format.h>

#include "core/error.hpp"

namespace touchdown {

/// A hidden folder beside what is being made, gone afterwards with all that was not moved out of
/// it. Errors: `Error` when it cannot be made.
class PartFolder {
 public:
  explicit PartFolder(const std::filesystem::path& stem) {
    try {
      const std::filesystem::path parent = std::filesystem::absolute(stem).parent_path();
      std::filesystem::create_directories(parent);
      path_ = parent / fmt::format(".{}.{}.part", stem.filename().string(), ::getpid());
      std::filesystem::create_directory(path_);
    } catch (const std::filesystem::filesystem_error& error) {
      throw Error(fmt::format("{}: cannot be written: {}", stem.string(), error.code().message()));
    }
  }
  ~PartFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  PartFolder(const PartFolder&) = delete;
  PartFolder& operator=(const PartFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace touchdown
