#pragma once

#include <filesystem>
#include <string>

#include "experiments/submissions/export.hpp"
#include "experiments/experiment_context.hpp"

namespace touchdown::experiments {

/// What of a benchmark is handed out, and where to.
struct ExportRequest {
  std::filesystem::path source;  ///< an experiment file, or the run directory of one
  std::filesystem::path folder;
  BenchmarkPart part;
};

/// How many files it would be and how large at most, by robot, sensors and engine, for people.
/// Nothing is computed or written. Errors: those of `export_benchmark` that are about the request.
std::string export_outline(const ExportRequest& request);

/// Writes what estimators of a benchmark hear for estimators that are none of ours. Runs that are
/// recorded in the run directory are read, all others are simulated. Errors: `InputError` for a
/// wrong request; those of `export_runs`.
ExportReport export_benchmark(const ExportRequest& request, const RunOptions& options);

}  // namespace touchdown::experiments
