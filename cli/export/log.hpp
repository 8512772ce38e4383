#pragma once

#include <string>

#include "cli/verbs.hpp"

namespace touchdown::cli {

/// Somebody else's log, and what becomes of it.
struct ExportedLog {
  std::string log;      ///< .csv or .npz
  std::string mapping;  ///< .yaml
  std::string output;   ///< .mpack
  std::string labels;   ///< .csv, or empty
};

/// Writes it as a log in Upkie's layout, and what it says about contact as labels, and says so.
/// Errors: `InputError`, and nothing is written.
void export_log(const ExportedLog& files, const CliSession& session);

/// Writes a log, with the beliefs that are in it, as an MCAP file, and says so. Errors: as above.
void export_mcap(const std::string& log, const std::string& output, const CliSession& session);

}  // namespace touchdown::cli
