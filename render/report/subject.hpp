#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "experiments/config/experiment.hpp"
#include "experiments/results/scores.hpp"

namespace touchdown::render {

/// The subject of a report: a run directory's experiment and its results.
struct ReportSubject {
  std::filesystem::path directory;
  nlohmann::ordered_json manifest;
  std::string config_text;
  experiments::Experiment experiment;
  experiments::ScoreTables tables;
  std::vector<std::string> edited_tables;  ///< `experiments::edited_tables`
};

/// Reads a run directory. Errors: `InputError` when it is not a run directory or one of its files
/// is broken.
ReportSubject read_subject(const std::filesystem::path& run_directory);

}  // namespace touchdown::render
