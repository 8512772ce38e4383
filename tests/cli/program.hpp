#pragma once

#include <filesystem>
#include <string>

namespace touchdown {

/// What a program said and how it ended.
struct Ended {
  int exit_code = -1;
  std::string output;  ///< standard output
  std::string errors;  ///< standard error
};

/// Runs the `touchdown` that was built, with these arguments, in `folder`.
Ended touchdown_program(const std::string& arguments, const std::filesystem::path& folder);

/// An empty folder that is gone when the test is over.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Writes a file and returns its path.
  std::filesystem::path write(const std::string& name, const std::string& content) const;

 private:
  std::filesystem::path path_;
};

/// Writes an experiment that takes about a second, and its scenarios, into the folder; returns its
/// file name.
std::string write_tiny_experiment(const ScratchFolder& folder);

}  // namespace touchdown
