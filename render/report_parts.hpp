#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/experiment.hpp"
#include "experiments/paper_tables.hpp"
#include "render/report.hpp"

namespace touchdown {

/// What a report is about.
struct ReportSubject {
  std::filesystem::path directory;
  nlohmann::ordered_json manifest;
  std::string config_text;
  Experiment experiment;

  std::filesystem::path table(const std::string& name) const { return directory / "tables" / name; }
};

/// A part of the report with its place in the list of contents; empty where there is nothing to
/// say.
struct ReportSection {
  std::string id;
  std::string title;
  std::string html = {};
};

ReportSection results_section(const ReportSubject& subject);
ReportSection heatmap_section(const ReportSubject& subject);
ReportSection paper_section(const ReportSubject& subject);
ReportSection figures_section(const ReportSubject& subject);
ReportSection more_tables_section(const ReportSubject& subject);
ReportSection reproduce_section(const ReportSubject& subject);
std::string film_html(const ReportFilm& film, const std::filesystem::path& directory);
/// Title, one sentence, and the numbers that say how much was done.
std::string header_html(const ReportSubject& subject);

/// The table with a caption; the first `text_columns` name the row.
std::string table_html(const CaptionedTable& table, std::size_t text_columns);
/// Columns `x`, `x_low`, `x_high` as one; names as people write them.
Table readable(const Table& table);

/// "MuJoCo"; "Bayes filter (robust)"; the name itself where there is no better one.
std::string engine_title(const std::string& simulator);
std::string estimator_title(const std::string& estimator);
/// When a wheel counts as in contact, what is scored, what the intervals are over.
std::string conditions_text(const Experiment& experiment);

}  // namespace touchdown
