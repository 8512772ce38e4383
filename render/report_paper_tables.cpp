#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "experiments/estimator_registry.hpp"
#include "render/csv_file.hpp"
#include "render/html.hpp"
#include "render/report_parts.hpp"

namespace touchdown {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

bool is_known(const std::string& estimator) {
  const auto entries = estimator_entries();
  return std::any_of(entries.begin(), entries.end(),
                     [&](const EstimatorEntry& entry) { return entry.name == estimator; });
}

bool is_at(const TableRow& row, const NoiseCell& cell) {
  return std::abs(row.number("torque_noise_nm") - cell.torque) < 1e-9 &&
         std::abs(row.number("accelerometer_noise_mps2") - cell.accelerometer) < 1e-9;
}

std::vector<Interval> no_metrics() { return {metrics().size(), Interval{nan, nan, nan}}; }

/// What the tables say about both wheels in one noise cell, put together again.
std::vector<ScoreSummary> scores_in(const ReportSubject& subject, const NoiseCell& cell) {
  std::vector<ScoreSummary> scores;
  for (const char* file : {"views.csv", "transitions.csv", "latency.csv", "calibration.csv"}) {
    const auto table = read_csv(subject.table(file));
    if (!table) continue;
    for (const TableRow& row : rows_of(*table)) {
      const std::string& simulator = row.text("simulator");
      const std::string& estimator = row.text("estimator");
      if (row.text("view") != "wheels" || !is_at(row, cell) || !is_known(estimator)) continue;
      auto found = std::find_if(scores.begin(), scores.end(), [&](const ScoreSummary& score) {
        return score.condition.test_simulator == simulator &&
               score.condition.estimator == estimator;
      });
      if (found == scores.end()) {
        scores.push_back({{simulator, simulator, estimator}, cell, "wheels", {}, no_metrics(), {}});
        found = scores.end() - 1;
      }
      for (std::size_t m = 0; m < metrics().size(); ++m) {
        if (row.has(metrics()[m].name)) found->metric[m] = row.interval(metrics()[m].name);
      }
    }
  }
  return scores;
}

std::vector<Difference> differences_in(const ReportSubject& subject, const NoiseCell& cell) {
  std::vector<Difference> differences;
  const auto table = read_csv(subject.table("differences.csv"));
  if (!table) return differences;
  for (const TableRow& row : rows_of(*table)) {
    const std::string &simulator = row.text("simulator"), &first = row.text("first"),
                      &second = row.text("second");
    if (!is_at(row, cell) || !is_known(first) || !is_known(second)) continue;
    auto found = std::find_if(differences.begin(), differences.end(), [&](const Difference& d) {
      return d.simulator == simulator && d.first == first && d.second == second;
    });
    if (found == differences.end()) {
      differences.push_back({simulator, cell, first, second, no_metrics()});
      found = differences.end() - 1;
    }
    for (std::size_t m = 0; m < metrics().size(); ++m) {
      if (metrics()[m].name == row.text("metric")) found->metric[m] = row.interval("difference");
    }
  }
  return differences;
}

void name_engines(Table& table) {
  for (auto& row : table.rows) row[0] = engine_title(row[0]);
}

}  // namespace

ReportSection paper_section(const ReportSubject& subject) {
  ReportSection section{"paper", "Beside the paper", {}};
  for (const NoiseCell& cell : subject.experiment.highlights) {
    const std::vector<ScoreSummary> scores = scores_in(subject, cell);
    if (scores.empty()) continue;
    const std::string how =
        fmt::format("Torque noise {} N·m, accelerometer noise {} m/s², {} noise {}.", cell.torque,
                    cell.accelerometer, subject.experiment.noise.seeds,
                    subject.experiment.noise.seeds == 1 ? "seed" : "seeds");
    std::string tables;
    for (CaptionedTable& table : paper_tables(scores, how)) {
      name_engines(table.table);
      tables += table_html(table, 2);
    }
    const std::vector<Difference> compared = differences_in(subject, cell);
    if (!compared.empty()) {
      CaptionedTable table = difference_text_table(compared);
      table.caption =
          "Paired differences: both estimators heard the same runs through the same "
          "noise. " +
          how;
      name_engines(table.table);
      tables += table_html(table, 2);
    }
    section.html +=
        fmt::format("<details{}><summary>{} N·m, {} m/s²</summary>\n{}</details>\n",
                    section.html.empty() ? " open" : "", cell.torque, cell.accelerometer, tables);
  }
  if (!section.html.empty()) {
    section.html =
        fmt::format(
            "<p>The last column repeats what the paper measured on the real robot: another "
            "machine, ten other drops, labels by hand, no intervals. It is a reference, not "
            "a mark to pass. {}</p>\n",
            escaped(conditions_text(subject.experiment))) +
        section.html;
  }
  return section;
}

}  // namespace touchdown
