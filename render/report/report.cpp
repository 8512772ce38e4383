#include "render/report/report.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "render/report/figures.hpp"
#include "render/report/findings.hpp"
#include "render/report/html.hpp"
#include "render/report/noise.hpp"
#include "render/report/page.hpp"
#include "render/report/results.hpp"
#include "render/report/tables.hpp"

namespace touchdown::render {
namespace {

namespace fs = std::filesystem;

std::string text_of(const nlohmann::ordered_json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return fmt::format("{:.3g}", value.get<double>());
  return value.dump();
}

void add_rows(const nlohmann::ordered_json& manifest, const char* key, const std::string& prefix,
              Table& table) {
  if (!manifest.contains(key) || !manifest[key].is_object()) return;
  for (const auto& [name, value] : manifest[key].items()) {
    if (std::string(key) == "host" && name == "name") continue;
    table.rows.push_back({prefix + name, text_of(value)});
  }
}

/// The command, versions, seeds and configuration that reproduce the numbers.
ReportSection reproduce_section(const ReportSubject& subject) {
  const auto& manifest = subject.manifest;
  std::string html =
      "<p>One command computes everything on this page again, from the configuration beside it. "
      "The "
      "same program gives the same numbers, to the last digit:</p>\n"
      "<pre><code>touchdown run config.yaml</code></pre>\n";
  if (manifest.contains("command") && manifest["command"].is_string()) {
    html += fmt::format("<p>The command of this run:</p>\n<pre><code>{}</code></pre>\n",
                        escaped(manifest["command"].get<std::string>()));
  }
  Table table{{"quantity", "value"}, {}};
  for (const char* key : {"id", "finished_at"}) {
    if (manifest.contains(key)) table.rows.push_back({key, text_of(manifest[key])});
  }
  add_rows(manifest, "versions", "version: ", table);
  add_rows(manifest, "seeds", "seed: ", table);
  add_rows(manifest, "host", "", table);
  add_rows(manifest, "timings_s", "seconds to ", table);
  for (auto& row : table.rows) {
    std::replace(row[0].begin(), row[0].end(), '_', ' ');
  }
  html += table_html({"Versions, seeds and computing times", "versions and seeds", table}, 1);
  if (manifest.contains("failed_runs") && manifest["failed_runs"].is_array() &&
      !manifest["failed_runs"].empty()) {
    Table failed{{"recording", "outcome"}, {}};
    for (const auto& run : manifest["failed_runs"]) {
      if (!run.is_object()) continue;  // the file may have been edited
      const auto text = [&](const char* key) {
        return run.contains(key) ? text_of(run[key]) : std::string();
      };
      failed.rows.push_back(
          {text("recording"), run.contains("ending") ? text("ending") : text("outcome")});
    }
    html += table_html({"Runs that are not scored", "failed runs", failed}, 1);
  }
  html += fmt::format(
      "<details><summary>The configuration, every default written out</summary>\n"
      "<pre tabindex=\"0\"><code>{}</code></pre></details>\n",
      escaped(subject.config_text));
  return {"reproduce", "Reproduction", html};
}

}  // namespace

fs::path write_report(const ReportSubject& subject, const std::vector<ReportSection>& of_runs,
                      const std::vector<ReportSection>& of_studies) {
  fs::path path = subject.directory / "report.html";
  std::vector<ReportSection> sections = of_runs;
  sections.push_back(estimators_section(subject));
  sections.push_back(results_section(subject));
  sections.insert(sections.end(), of_studies.begin(), of_studies.end());
  for (ReportSection (*const section)(const ReportSubject&) :
       {heatmap_section, paper_section, figures_section, more_tables_section, reproduce_section}) {
    sections.push_back(section(subject));
  }
  write_page(subject, path, header_html(subject), std::move(sections));
  return path;
}

}  // namespace touchdown::render
