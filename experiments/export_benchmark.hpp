#pragma once

#include <filesystem>
#include <string>

#include "experiments/experiment_context.hpp"
#include "experiments/submissions/export.hpp"

namespace touchdown::experiments {

/// Which part of a benchmark is exported, and where to.
struct ExportRequest {
  std::filesystem::path source;  ///< an experiment file, or a run directory
  std::filesystem::path folder;
  BenchmarkPart part;
};

/// A table for the user: the number of files and their largest size, by robot, sensors and engine.
/// Computes and writes nothing. Errors: those of `export_benchmark` about the request.
std::string export_outline(const ExportRequest& request);

/// Writes the sensor signals of a benchmark to files, for submitted estimators. Reads the runs that
/// the run directory has recordings of, and simulates all others. Errors: `InputError` for a wrong
/// request; those of `export_runs`.
ExportReport export_benchmark(const ExportRequest& request, const RunOptions& options);

}  // namespace touchdown::experiments
