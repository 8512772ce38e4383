#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/config/experiment.hpp"
#include "experiments/results/summary_file.hpp"

namespace touchdown::render {

/// What a report is about: a run directory's experiment and what it found out.
struct ReportSubject {
  std::filesystem::path directory;
  nlohmann::ordered_json manifest;
  std::string config_text;
  experiments::Experiment experiment;
  experiments::Summary summary;
};

/// Errors: `InputError` when it is no run directory or one of its files is broken.
ReportSubject read_subject(const std::filesystem::path& run_directory);

/// The names of those that the scores tell of, in their order.
std::vector<std::string> scored_estimators(const std::vector<experiments::CellSummary>& scores);

}  // namespace touchdown::render
