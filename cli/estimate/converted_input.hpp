#pragma once

#include <filesystem>
#include <string>

#include "cli/verbs.hpp"
#include "core/files.hpp"

namespace touchdown::cli {

/// A log of another robot, converted to Upkie's layout in a temporary folder that is deleted with
/// this object.
class ConvertedInput {
 public:
  /// Prints one line for each thing that a user should know. Errors: those of
  /// `recordings::convert_log`; `Stopped`.
  ConvertedInput(const std::string& log, const std::string& mapping, const CliSession& session);

  std::filesystem::path path() const { return folder_.path() / "log.mpack"; }

 private:
  PartFolder folder_;
};

}  // namespace touchdown::cli
