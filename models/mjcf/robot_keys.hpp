#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace touchdown::models {

/// The keys of a robot's YAML file, for errors at their values.
class RobotKeys {
 public:
  explicit RobotKeys(std::filesystem::path file) : file_(std::move(file)) {}

  /// Throws an `InputError` at a dotted key, such as `joints.left_hip` or `held.0`.
  [[noreturn]] void fail(std::string_view key, const std::string& message) const;

 private:
  std::filesystem::path file_;
};

}  // namespace touchdown::models
