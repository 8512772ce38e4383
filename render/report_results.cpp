#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "render/csv_file.hpp"
#include "render/html.hpp"
#include "render/report_parts.hpp"

namespace touchdown {
namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? " and " : ", ";
    text += words[i];
  }
  return text;
}

std::vector<std::string> engines_of(const Experiment& experiment) {
  std::vector<std::string> engines;
  for (const std::string& simulator : experiment.simulators) {
    engines.push_back(engine_title(simulator));
  }
  return engines;
}

std::string fact(const std::string& name, const std::string& value) {
  return fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", escaped(name), escaped(value));
}

bool same(double a, double b) { return std::abs(a - b) < 1e-9; }

}  // namespace

std::string conditions_text(const Experiment& experiment) {
  return fmt::format(
      "Both wheels; contact: normal force > {} N, states under {:.3g} ms merged; first {:.3g} ms "
      "not scored; {:.0f} % bootstrap intervals over {}s.",
      experiment.labels.force_threshold, 1e3 * experiment.labels.debounce,
      1e3 * experiment.scoring.skip, 100.0 * experiment.intervals.bootstrap.level,
      experiment.intervals.over == SampleUnit::run ? "run" : "drop");
}

std::string header_html(const ReportSubject& subject) {
  const Experiment& experiment = subject.experiment;
  int test_runs = 0, unusable = 0;
  double flights = 0.0;
  if (const auto runs = read_csv(subject.table("runs.csv"))) {
    for (const TableRow& run : rows_of(*runs)) {
      if (run.text("role") != "test") continue;
      const bool scored = run.text("outcome") == "finished" || run.text("outcome") == "timed_out";
      (scored ? test_runs : unusable) += 1;
      if (scored && std::isfinite(run.number("flights"))) flights += run.number("flights");
    }
  }
  std::set<std::string> cells;
  if (const auto success = read_csv(subject.table("success.csv"))) {
    for (const TableRow& row : rows_of(*success)) {
      cells.insert(row.text("torque_noise_nm") + " " + row.text("accelerometer_noise_mps2") + " " +
                   row.text("knee_noise_nm") + " " + row.text("wheel_noise_nm"));
    }
  }
  std::string html = fmt::format(
      "<p class=\"kicker\">Contact estimation on a wheeled biped</p>\n<h1>{}</h1>\n"
      "<p class=\"lead\">Does the robot touch the ground? {} {} answer from joint torques and an "
      "accelerometer, in {}, through sensor noise.</p>\n<dl class=\"facts\">\n",
      escaped(experiment.name), experiment.estimators.size(),
      experiment.estimators.size() == 1 ? "estimator" : "estimators",
      escaped(joined(engines_of(experiment))));
  html += fact("physics engines", std::to_string(experiment.simulators.size()));
  html += fact("test runs scored", std::to_string(test_runs));
  html += fact("flights in them", fmt::format("{:.0f}", flights));
  html += fact("noise settings", std::to_string(cells.size()));
  html += fact("noise seeds each", std::to_string(experiment.noise.seeds));
  html += "</dl>\n";
  html += fmt::format("<p class=\"note\">{}", escaped(conditions_text(experiment)));
  if (unusable > 0) {
    html += fmt::format(" {} test {} fell, diverged or could not be simulated and {} not scored.",
                        unusable, unusable == 1 ? "run" : "runs", unusable == 1 ? "is" : "are");
  }
  return html + "</p>\n";
}

ReportSection results_section(const ReportSubject& subject) {
  ReportSection section{"results", "Success rates", {}};
  const auto success = read_csv(subject.table("success.csv"));
  if (!success || success->rows.empty()) return section;
  const Experiment& experiment = subject.experiment;
  std::vector<std::string> estimators;
  for (const TableRow& row : rows_of(*success)) {
    const std::string& name = row.text("estimator");
    if (std::find(estimators.begin(), estimators.end(), name) == estimators.end()) {
      estimators.push_back(name);
    }
  }
  std::vector<NoiseCell> cells = experiment.highlights;
  if (cells.empty()) {
    const TableRow first = rows_of(*success).front();
    cells.push_back({first.number("torque_noise_nm"), first.number("accelerometer_noise_mps2")});
  }
  for (const NoiseCell& cell : cells) {
    CaptionedTable table{
        fmt::format("Share of steps that are judged rightly, with torque noise of {} N·m and "
                    "accelerometer noise of {} m/s². “Always contact” is what a constant answer "
                    "earns.",
                    cell.torque, cell.accelerometer),
        fmt::format("success rates at {} N·m and {} m/s²", cell.torque, cell.accelerometer),
        {{"estimator"}, {}}};
    for (const std::string& engine : engines_of(experiment)) table.table.header.push_back(engine);
    for (const std::string& estimator : estimators) {
      std::vector<std::string> line = {estimator_title(estimator)};
      for (const std::string& simulator : experiment.simulators) {
        line.emplace_back("–");
        for (const TableRow& row : rows_of(*success)) {
          if (row.text("simulator") == simulator && row.text("estimator") == estimator &&
              same(row.number("torque_noise_nm"), cell.torque) &&
              same(row.number("accelerometer_noise_mps2"), cell.accelerometer)) {
            line.back() = with_interval(row.interval("success"));
            break;
          }
        }
      }
      table.table.rows.push_back(std::move(line));
    }
    section.html += table_html(table, 1);
  }
  return section;
}

}  // namespace touchdown
