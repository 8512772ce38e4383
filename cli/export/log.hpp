#pragma once

#include <string>

#include "cli/verbs.hpp"

namespace touchdown::cli {

/// Files of the conversion of a log in another layout.
struct ExportedLog {
  std::string log;         ///< .csv, .npz, a ROS 2 bag, or the folder of several sources
  std::string mapping;     ///< .yaml
  std::string output;      ///< .mpack
  std::string labels;      ///< .csv, or empty
  bool is_strict = false;  ///< whether implausible signals are an error
};

/// Converts the log to Upkie's layout, writes its contact column as labels and prints a summary.
/// Errors: `InputError`; nothing is written then.
void export_log(const ExportedLog& files, const CliSession& session);

/// Writes a log, with the beliefs in it, as an MCAP file and prints a summary. If the log contains
/// its scene, or a `robot` is named, the file shows it too (render/report/mcap.hpp). Errors: as
/// above.
void export_mcap(const std::string& log, const std::string& robot, const std::string& output,
                 const CliSession& session);

}  // namespace touchdown::cli
