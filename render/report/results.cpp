#include "render/report/results.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <set>

#include <fmt/format.h>

#include "experiments/results/captions.hpp"
#include "render/report/findings.hpp"
#include "render/report/tables.hpp"
#include "simulators/registry.hpp"

namespace touchdown::render {
namespace {

std::vector<std::string> engines_of(const experiments::Experiment& experiment) {
  std::vector<std::string> engines;
  for (const std::string& simulator : experiment.simulators) {
    engines.push_back(simulators::simulator_title(simulator));
  }
  return engines;
}

template <typename Row>
std::vector<Row> rows_at(const std::vector<Row>& rows, const noise::NoiseCell& cell) {
  std::vector<Row> found;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(found),
               [&](const Row& row) { return row.cell == cell; });
  return found;
}

std::string with_engine_titles(experiments::CaptionedTable table) {
  for (auto& row : table.table.rows) row[0] = simulators::simulator_title(row[0]);
  return table_html(table, 2);
}

}  // namespace

std::string header_html(const ReportSubject& subject) {
  const experiments::Experiment& experiment = subject.experiment;
  int test_runs = 0, unusable = 0, flights = 0;
  for (const experiments::RunSummary& run : subject.summary.runs) {
    if (run.role != experiments::RunRole::test) continue;
    const bool scored = !experiments::is_failure(run.outcome);
    (scored ? test_runs : unusable) += 1;
    if (scored) flights += run.flights;
  }
  std::set<std::array<double, 3>> settings;
  for (const experiments::CellSummary& score : subject.summary.cells) {
    settings.insert({score.cell.accelerometer, score.cell.knee, score.cell.wheel});
  }
  std::string html = fmt::format(
      "<p class=\"kicker\">Contact estimation on a wheeled biped</p>\n<h1>{}</h1>\n"
      "<p class=\"lead\">Is each wheel in contact with the ground? {} {} it from joint torques and "
      "an "
      "accelerometer, in {}, under sensor noise.</p>\n<dl class=\"facts\">\n",
      escaped(experiment.name), experiments::plural(experiment.estimators.size(), "estimator"),
      experiment.estimators.size() == 1 ? "estimates" : "estimate",
      escaped(in_words(engines_of(experiment))));
  html += fact_html("physics engines", std::to_string(experiment.simulators.size()));
  html += fact_html("test runs scored", std::to_string(test_runs));
  html += fact_html("flights in these runs", std::to_string(flights));
  html += fact_html("noise settings", std::to_string(settings.size()));
  html += fact_html("noise seeds per run", std::to_string(experiment.noise.seeds));
  html += "</dl>\n";
  html += fmt::format("<p class=\"note\">{}", escaped(experiments::conditions_text(experiment)));
  if (unusable > 0) {
    html += fmt::format(" {} test {} fell, diverged or could not be simulated and {} not scored.",
                        unusable, unusable == 1 ? "run" : "runs", unusable == 1 ? "is" : "are");
  }
  return html + "</p>\n";
}

ReportSection results_section(const ReportSubject& subject) {
  ReportSection section{"results", "Results", {}};
  const std::vector<experiments::CellSummary>& scores = subject.summary.cells;
  if (scores.empty()) return section;
  section.html = findings_html(subject);
  const experiments::Experiment& experiment = subject.experiment;
  std::vector<noise::NoiseCell> cells = experiment.highlights;
  if (cells.empty()) cells.push_back(scores.front().cell);
  for (const noise::NoiseCell& cell : cells) {
    experiments::CaptionedTable table{
        fmt::format(
            "Accuracy, the share of steps with a correct decision, and false takeoffs per minute "
            "and wheel, with torque noise of {} N·m and accelerometer noise of {} m/s². “Always "
            "contact” is the constant answer{}.",
            cell.torque, cell.accelerometer, experiments::setup_caption(experiment)),
        fmt::format("accuracies at {} N·m and {} m/s²", cell.torque, cell.accelerometer),
        {{"estimator"}, {}}};
    for (const std::string& engine : engines_of(experiment)) {
      table.table.header.insert(table.table.header.end(), {engine, "false takeoffs/min"});
    }
    for (const std::string& estimator : scored_estimators(scores)) {
      std::vector<std::string> line = {experiments::estimator_title(estimator)};
      for (const std::string& simulator : experiment.simulators) {
        const auto score =
            std::find_if(scores.begin(), scores.end(), [&](const experiments::CellSummary& s) {
              return s.condition.test_simulator == simulator &&
                     s.condition.estimator == estimator && s.cell == cell;
            });
        if (score == scores.end()) {
          line.insert(line.end(), {"–", "–"});
          continue;
        }
        line.push_back(with_interval(score->success));
        line.push_back(experiments::false_takeoffs_text(subject.summary.scores, *score));
      }
      table.table.rows.push_back(std::move(line));
    }
    section.html += table_html(table, 1);
  }
  return section;
}

ReportSection paper_section(const ReportSubject& subject) {
  ReportSection section{"paper", "Comparison with the paper", {}};
  for (const noise::NoiseCell& cell : subject.experiment.highlights) {
    const std::vector<experiments::ScoreSummary> scores = rows_at(subject.summary.scores, cell);
    if (scores.empty()) continue;
    const std::string how = fmt::format(
        "Torque noise {} N·m, accelerometer noise {} m/s², {}{}.", cell.torque, cell.accelerometer,
        experiments::plural(static_cast<std::size_t>(subject.experiment.noise.seeds), "noise seed"),
        experiments::setup_caption(subject.experiment));
    std::string tables;
    for (const experiments::CaptionedTable& table :
         experiments::paper_tables(subject.experiment, scores, how)) {
      tables += with_engine_titles(table);
    }
    const std::vector<experiments::Difference> compared =
        rows_at(subject.summary.differences, cell);
    if (!compared.empty()) {
      experiments::CaptionedTable table =
          experiments::difference_text_table(subject.experiment, compared);
      table.caption =
          "Paired differences: both estimators processed the same runs with the same noise. " + how;
      tables += with_engine_titles(table);
    }
    section.html +=
        fmt::format("<details{}><summary>{} N·m, {} m/s²</summary>\n{}</details>\n",
                    section.html.empty() ? " open" : "", cell.torque, cell.accelerometer, tables);
  }
  if (!section.html.empty()) {
    section.html = fmt::format(
                       "<p>The last column repeats the paper's measurements on the real robot: "
                       "another machine, ten other drops, labels by hand, no intervals. It is a "
                       "reference, not a target. {}</p>\n",
                       escaped(experiments::conditions_text(subject.experiment))) +
                   section.html;
  }
  return section;
}

}  // namespace touchdown::render
