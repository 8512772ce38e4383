#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "experiments/plan/rollouts.hpp"
#include "experiments/submissions/exported_runs.hpp"

namespace touchdown::experiments {

/// The result of an export.
struct ExportReport {
  std::size_t files = 0;            ///< files of signals
  std::uintmax_t bytes = 0;         ///< of these files
  std::vector<std::string> failed;  ///< recordings of failed runs, which are not exported
};

/// Upper bound of the size of these runs on disk (bytes).
double bytes_at_most(std::span<const ExportedRun> runs, const Plan& plan);

/// Writes the inputs of estimators for these runs into a new or an empty folder, with `README.md`,
/// `index.csv` and `SHA256SUMS`: all files or none. Equal runs give equal bytes. Recordings are
/// read from `directory`; missing ones are simulated. Errors: `InputError` for a folder that is not
/// empty; `Error` for too little disk space; `Stopped`.
ExportReport export_runs(const RunRequest& request, const Plan& plan,
                         const std::vector<ExportedRun>& runs, const RunDirectory& directory,
                         const std::filesystem::path& folder,
                         const ShouldContinue& should_continue);

}  // namespace touchdown::experiments
