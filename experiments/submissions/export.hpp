#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "experiments/submissions/exported_runs.hpp"
#include "experiments/rollouts/rollouts.hpp"

namespace touchdown::experiments {

/// What an export came to.
struct ExportReport {
  std::size_t files = 0;            ///< of signals
  std::uintmax_t bytes = 0;         ///< likewise
  std::vector<std::string> failed;  ///< recordings that are not scored, and so not handed out
};

/// The most that these take on a disk (bytes).
double bytes_at_most(std::span<const HeardRun> runs, const Plan& plan);

/// Plays the runs and writes what estimators hear of them into a new or an empty folder, with
/// `README.md`, `index.csv` and `SHA256SUMS`: all of it or nothing. The same runs give the same
/// bytes. `directory` is where recordings may be; those that are not are simulated. Errors:
/// `InputError` for a folder that holds something; `Error` for too small a disk; `Stopped`.
ExportReport export_runs(const RunRequest& request, const Plan& plan,
                         const std::vector<HeardRun>& runs, const RunDirectory& directory,
                         const std::filesystem::path& folder, const ShouldContinue& should_continue);

}  // namespace touchdown::experiments
