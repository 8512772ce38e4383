#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/fields.hpp"

namespace touchdown::recordings {

/// Sources with clocks of their own that a mapping joins: files of one folder, or topics of a bag.
struct LogSources {
  std::vector<std::string> joints;  ///< empty: the log is one file
  std::vector<std::string> imu;
  std::vector<std::string> contact;  ///< empty: among the joints' columns
  double stale_after = 0.05;         ///< older values are missing (s)

  bool empty() const { return joints.empty(); }
  /// Whether they are named like files, not like topics.
  bool are_files() const;
};

/// The keys of `sources`.
void describe(Fields& fields, LogSources& sources);

/// Reads only `sources` of a mapping file. Errors: `InputError` with file:line:column.
LogSources read_log_sources(const std::filesystem::path& mapping);

}  // namespace touchdown::recordings
