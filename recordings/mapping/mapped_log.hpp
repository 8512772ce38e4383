#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/files.hpp"

namespace touchdown::recordings {

/// Another robot's log or ROS 2 bag as a log in Upkie's layout, for programs that read such logs.
/// It is in a temporary folder, which is deleted with this object.
class MappedLog {
 public:
  /// `check_stop` is called regularly, and may throw. Errors: those of `convert_log`; `Error` if
  /// the disk is full.
  MappedLog(const std::filesystem::path& log, const std::filesystem::path& mapping,
            const std::function<void()>& check_stop = {});

  std::filesystem::path path() const { return folder_.path() / "log.mpack"; }
  /// One line for each thing that a user should know.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  PartFolder folder_;
  std::vector<std::string> warnings_;
};

}  // namespace touchdown::recordings
