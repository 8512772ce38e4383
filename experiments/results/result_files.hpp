#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "experiments/results/result.hpp"

namespace touchdown::experiments {

/// Writes a model of the fit with this key into `models/`, unless it is that of a refit.
void write_model_of(const std::string& key, const std::string& estimator, const Model& model,
                    const RunDirectory& directory);

/// The table `runs.csv`.
Table runs_table(const std::vector<FinishedRun>& runs);

/// Writes an experiment's result into its run directory: `tables/` and `models/`.
void write_result_files(const ExperimentResult& result);

/// The digests of the files in `tables/` that a run made, by their names.
std::map<std::string, std::string> table_digests(const std::filesystem::path& run_directory);

/// The files in `tables/` that differ from what the run wrote. None for runs of older programs:
/// their manifests hold no digests.
std::vector<std::string> edited_tables(const std::filesystem::path& run_directory);

/// A line if `config.yaml` of a finished run states another experiment than the run's; otherwise
/// none. Errors: `InputError` for a file that was edited and states none.
std::vector<std::string> config_warnings(const std::filesystem::path& run_directory);

/// Writes `manifest.json`: versions, seeds, host, timings, failed runs, inputs, digests of the
/// tables. Call it again to add later timings.
void write_manifest(const ExperimentResult& result);

}  // namespace touchdown::experiments
