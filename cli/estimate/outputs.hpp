#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace touchdown::cli {

/// Where the beliefs about one log go; empty: nowhere.
struct EstimateOutputs {
  std::filesystem::path csv;  ///< "-" is standard output
  std::filesystem::path mpack;
  std::filesystem::path figure;  ///< without its extension

  bool prints_csv() const { return csv == "-"; }
};

/// Tells outputs apart by their extensions, `.csv` and `.mpack`; for several logs, the log's name
/// is put before each. Errors: `InputError` for another extension, two outputs of a kind, an output
/// that two logs share, and those of `check_outputs`; `Error` for one that cannot be written.
std::vector<EstimateOutputs> estimate_outputs(const std::vector<std::string>& logs,
                                              const std::string& model,
                                              const std::vector<std::string>& labels,
                                              const std::vector<std::string>& outputs,
                                              const std::string& figure);

/// Opens the files, calls `use` with their streams (null where there is none), and makes them
/// appear, whole, if it returns.
void write_outputs(const EstimateOutputs& outputs,
                   const std::function<void(std::ostream* csv, std::ostream* mpack)>& use);

}  // namespace touchdown::cli
