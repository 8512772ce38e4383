#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <set>

#include <fmt/format.h>

#include "experiments/config/experiment.hpp"
#include "experiments/estimators/baselines.hpp"
#include "experiments/results/captions.hpp"
#include "render/figures/figures.hpp"
#include "render/report/sections.hpp"
#include "simulators/registry.hpp"

namespace touchdown::render {

namespace {

using Scores = std::vector<experiments::ScoreSummary>;

/// "knee torques, wheel torques and the accelerometer"; "no noisy signal".
std::string inputs_text(const experiments::Sensors& sensors) {
  std::vector<std::string> inputs;
  if (sensors.hip_torque) inputs.emplace_back("hip torques");
  if (sensors.knee_torque) inputs.emplace_back("knee torques");
  if (sensors.wheel_torque) inputs.emplace_back("wheel torques");
  if (sensors.acceleration) inputs.emplace_back("the accelerometer");
  if (sensors.joint_position) inputs.emplace_back("joint angles");
  if (sensors.joint_velocity) inputs.emplace_back("joint velocities");
  return inputs.empty() ? "no noisy signal" : in_words(inputs);
}

double f1_of(const experiments::ScoreSummary& score) { return score["event_f1"].estimate; }

/// The estimators' scores in one engine and noise cell, the highest F1 first.
Scores ranked(const Scores& all, const std::string& simulator, const noise::NoiseCell& noise) {
  Scores scores;
  std::ranges::copy_if(all, std::back_inserter(scores), [&](const auto& score) {
    return score.condition.test_simulator == simulator && score.cell == noise &&
           score.view == "wheels" &&
           score.condition.estimator != experiments::always_contact_name &&
           std::isfinite(f1_of(score));
  });
  std::ranges::stable_sort(scores, std::greater<>(), f1_of);
  return scores;
}

/// "Without noise, Phase filter finds takeoffs and landings best: F1 .906 [.890, .920], ahead of
/// Free fall (.841) and NMN (.713). …" Estimators with the same number share the place.
std::string finding(const experiments::Experiment& experiment, const Scores& scores) {
  const experiments::ScoreSummary& best = scores.front();
  const auto text_of = [](double f1) { return fmt::format("{:.3f}", f1); };
  const bool is_noiseless = best.cell.torque == 0.0 && best.cell.accelerometer == 0.0;
  std::vector<std::string> leaders, next;
  for (const experiments::ScoreSummary& score : scores) {
    const std::string& name = score.condition.estimator;
    const std::string title = experiments::estimator_title_in(experiment, name);
    if (text_of(f1_of(score)) == text_of(f1_of(best))) {
      const bool is_own = experiments::is_fitted_to_test(experiment, name);
      leaders.push_back(title + (is_own ? ", fitted to these scenes," : ""));
    } else if (next.size() < 2) {
      next.push_back(fmt::format("{} ({})", title, text_of(f1_of(score))));
    }
  }
  return fmt::format("{}, {} {} takeoffs and landings best: F1 {}{}. ",
                     is_noiseless ? "Without noise" : "With " + experiments::noise_text(best.cell),
                     in_words(leaders), leaders.size() == 1 ? "finds" : "find",
                     leaders.size() == 1 ? with_interval(best["event_f1"]) : text_of(f1_of(best)),
                     next.empty() ? "" : ", ahead of " + in_words(next));
}

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

/// A paragraph per engine: the estimator with the highest F1 at each highlighted noise setting, and
/// those of the next two. Empty without scores.
std::string findings_html(const ReportSubject& subject) {
  const Scores& all = subject.summary.scores;
  if (all.empty()) return {};
  std::vector<noise::NoiseCell> settings = subject.experiment.highlights;
  if (settings.empty()) settings.push_back(all.front().cell);
  std::string html;
  for (const std::string& simulator : subject.experiment.simulators) {
    std::string text;
    for (const noise::NoiseCell& noise : settings) {
      const Scores scores = ranked(all, simulator, noise);
      if (!scores.empty()) text += finding(subject.experiment, scores);
    }
    if (text.empty()) continue;
    text.pop_back();
    html += fmt::format("<p><b>{}.</b> {}</p>\n", escaped(simulators::simulator_title(simulator)),
                        escaped(text));
  }
  return html;
}

}  // namespace

ReportSection estimators_section(const ReportSubject& subject) {
  ReportSection section{"estimators", "Estimators", "<dl class=\"estimators\">\n"};
  for (const std::string& name : subject.experiment.estimators) {
    const experiments::EstimatorEntry& entry =
        experiments::estimator_entry(subject.experiment, name);
    section.html += fmt::format("<dt>{}</dt><dd>{}. It uses {}.</dd>\n", escaped(entry.title),
                                escaped(entry.summary), escaped(inputs_text(entry.sensors)));
  }
  section.html += "</dl>\n";
  return section;
}

std::string header_html(const ReportSubject& subject) {
  const experiments::Experiment& experiment = subject.experiment;
  int test_runs = 0, unusable = 0, flights = 0, of_one_wheel = 0;
  for (const experiments::RunSummary& run : subject.summary.runs) {
    if (run.role != experiments::RunRole::test) continue;
    const bool scored = !experiments::is_failure(run.outcome);
    (scored ? test_runs : unusable) += 1;
    if (!scored) continue;
    flights += run.flights;
    of_one_wheel += run.wheel_flights;
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
  html += fact_html("flights of both wheels at once", std::to_string(flights));
  html += fact_html("flights of one wheel alone", std::to_string(of_one_wheel));
  html += fact_html("noise settings", std::to_string(settings.size()));
  html += fact_html("noise seeds per run", std::to_string(experiment.noise.seeds));
  html += "</dl>\n";
  html += fmt::format(
      "<p class=\"note\">Film, replay and latencies count each wheel's flights of at least {:.0f} "
      "ms. {}",
      1e3 * experiment.scoring.minimum_flight, escaped(experiments::conditions_text(experiment)));
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
  const std::string notes = experiments::score_notes(subject.experiment, subject.summary);
  if (!notes.empty()) section.html += fmt::format("<p>{}</p>\n", escaped(notes));
  const experiments::Experiment& experiment = subject.experiment;
  std::vector<noise::NoiseCell> cells = experiment.highlights;
  if (cells.empty()) cells.push_back(scores.front().cell);
  for (const noise::NoiseCell& cell : cells) {
    experiments::CaptionedTable table{
        fmt::format(
            "F1 of takeoffs and landings within 20 ms, decided switches that detect none of them, "
            "per "
            "minute and wheel, and the mean recall of contact and air, with torque noise of {} N·m "
            "and accelerometer noise of {} m/s². “Always contact” is the constant answer{}.",
            cell.torque, cell.accelerometer, experiments::setup_caption(experiment)),
        fmt::format("F1 at {} N·m and {} m/s²", cell.torque, cell.accelerometer),
        experiments::accuracy_table(experiment, scores, subject.summary.scores, cell,
                                    engines_of(experiment))};
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
