#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "apps/cli/log_options.hpp"

namespace touchdown::cli {

/// Output files of the beliefs about one log. An empty path means no output.
struct EstimateOutputs {
  std::filesystem::path csv;  ///< "-" is standard output
  std::filesystem::path mpack;
  std::filesystem::path mcap;
  std::filesystem::path figure;    ///< without its extension
  std::filesystem::path proposal;  ///< of labels

  bool prints_csv() const { return csv == "-"; }
};

/// The figure's path without its extension; empty for no figure. Errors: `InputError` for another
/// extension than .png, .svg and .pdf.
std::filesystem::path figure_stem(const std::string& figure);

/// The figure's files, with gnuplot's data and script; none without a figure.
std::vector<std::filesystem::path> figure_files(const std::filesystem::path& stem);

/// Output files as the command line gives them.
struct EstimateRequest {
  std::vector<std::string> outputs;
  std::string figure;
  std::string proposal;
};

/// Assigns outputs by their extensions, `.csv`, `.mpack` and `.mcap`. For several logs, each
/// output's name begins with the log's name, behind the folder's where logs have equal names.
/// Errors: `InputError` for another extension, two outputs of one kind, an output that two logs
/// share, and those of `check_outputs`; `Error` for an output that cannot be written.
std::vector<EstimateOutputs> estimate_outputs(const std::vector<std::string>& logs,
                                              const LogOptions& options,
                                              const std::vector<std::string>& labels,
                                              const EstimateRequest& request);

/// The streams of the outputs; null where there is no output.
struct EstimateStreams {
  std::ostream* csv = nullptr;
  std::ostream* mpack = nullptr;
  std::ostream* mcap = nullptr;
};

/// Opens temporary files and calls `use` with their streams. The complete files appear under their
/// names once `use` returns.
void write_outputs(const EstimateOutputs& outputs,
                   const std::function<void(const EstimateStreams& streams)>& use);

}  // namespace touchdown::cli
