#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>

#include <fmt/format.h>

#include "core/rows.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/estimators/baselines.hpp"
#include "experiments/results/captions.hpp"
#include "render/figures/figures.hpp"
#include "render/report/sections.hpp"
#include "simulators/registry.hpp"

namespace touchdown::render {

namespace {

using Scores = std::vector<TableRow>;

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

double f1_of(const TableRow& score) { return score.number("event_f1"); }

/// The estimators' scores in one engine and noise cell, the highest F1 first.
Scores ranked(const Table& all, const std::string& simulator, const noise::NoiseCell& noise) {
  Scores scores = where(all.all(), [&](const TableRow& score) {
    return score.text("simulator") == simulator && experiments::is_at(score, noise) &&
           score.text("view") == scoring::scored_views().front() &&
           score.text("estimator") != experiments::always_contact_name &&
           std::isfinite(f1_of(score));
  });
  std::ranges::stable_sort(scores, std::greater<>(), f1_of);
  return scores;
}

/// "Without noise, Phase filter finds takeoffs and landings best: F1 .906 [.890, .920], ahead of
/// Free fall (.841) and NMN (.713). …" Estimators with the same number share the place.
std::string finding(const experiments::Experiment& experiment, const noise::NoiseCell& noise,
                    const Scores& scores) {
  const TableRow& best = scores.front();
  const auto text_of = [](double f1) { return fmt::format("{:.3f}", f1); };
  const bool is_noiseless = noise.torque == 0.0 && noise.accelerometer == 0.0;
  std::vector<std::string> leaders, next;
  for (const TableRow& score : scores) {
    const std::string name = score.text("estimator");
    const std::string title = experiments::estimator_title_in(experiment, name);
    if (text_of(f1_of(score)) == text_of(f1_of(best))) {
      const bool is_own = experiments::is_fitted_to_test(experiment, name);
      leaders.push_back(title + (is_own ? ", fitted to these scenes," : ""));
    } else if (next.size() < 2) {
      next.push_back(fmt::format("{} ({})", title, text_of(f1_of(score))));
    }
  }
  return fmt::format(
      "{}, {} {} takeoffs and landings best: F1 {}{}. ",
      is_noiseless ? "Without noise" : "With " + experiments::noise_text(noise), in_words(leaders),
      leaders.size() == 1 ? "finds" : "find",
      leaders.size() == 1 ? with_interval(best.interval("event_f1")) : text_of(f1_of(best)),
      next.empty() ? "" : ", ahead of " + in_words(next));
}

std::vector<std::string> engines_of(const experiments::Experiment& experiment) {
  std::vector<std::string> engines;
  for (const std::string& simulator : experiment.simulators) {
    engines.push_back(simulators::simulator_title(simulator));
  }
  return engines;
}

std::string with_engine_titles(experiments::CaptionedTable table) {
  for (auto& row : table.table.rows) row[0] = simulators::simulator_title(row[0]);
  return table_html(table, 2);
}

/// A paragraph per engine: the estimator with the highest F1 at each highlighted noise setting, and
/// those of the next two. Empty without scores.
std::string findings_html(const ReportSubject& subject) {
  std::string html;
  for (const std::string& simulator : subject.experiment.simulators) {
    std::string text;
    for (const noise::NoiseCell& noise : subject.experiment.highlights) {
      const Scores scores = ranked(subject.tables.scores, simulator, noise);
      if (!scores.empty()) text += finding(subject.experiment, noise, scores);
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
  int test_runs = 0, unusable = 0;
  double flights = 0.0, of_one_wheel = 0.0;
  for (const TableRow& run : subject.tables.runs.all()) {
    if (run.text("role") != experiments::to_text(experiments::RunRole::test)) continue;
    const bool scored = experiments::is_scored(run);
    (scored ? test_runs : unusable) += 1;
    if (!scored) continue;
    flights += run.number("flights");
    of_one_wheel += run.number("wheel_flights");
  }
  std::set<std::array<double, 3>> settings;
  for (const TableRow& cell : subject.tables.cells.all()) {
    settings.insert({cell.number("accelerometer_noise_mps2"), cell.number("knee_noise_nm"),
                     cell.number("wheel_noise_nm")});
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
  html += fact_html("flights of both wheels at once", fmt::format("{:.0f}", flights));
  html += fact_html("flights of one wheel alone", fmt::format("{:.0f}", of_one_wheel));
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
  if (subject.tables.cells.rows.empty()) return section;
  section.html = findings_html(subject);
  const std::string notes = experiments::score_notes(subject.experiment, subject.tables);
  if (!notes.empty()) section.html += fmt::format("<p>{}</p>\n", escaped(notes));
  const experiments::Experiment& experiment = subject.experiment;
  for (const noise::NoiseCell& cell : experiment.highlights) {
    experiments::CaptionedTable table{
        fmt::format(
            "F1 of takeoffs and landings within 20 ms, decided switches that detect none of them, "
            "per "
            "minute and wheel, and the mean recall of contact and air, with torque noise of {} N·m "
            "and accelerometer noise of {} m/s². “Always contact” is the constant answer{}.",
            cell.torque, cell.accelerometer, experiments::setup_caption(experiment)),
        fmt::format("F1 at {} N·m and {} m/s²", cell.torque, cell.accelerometer),
        experiments::accuracy_table(experiment, subject.tables, cell, engines_of(experiment))};
    section.html += table_html(table, 1);
  }
  return section;
}

ReportSection paper_section(const ReportSubject& subject) {
  ReportSection section{"paper", "Comparison with the paper", {}};
  for (const noise::NoiseCell& cell : subject.experiment.highlights) {
    const auto is_here = [&](const TableRow& row) { return experiments::is_at(row, cell); };
    if (where(subject.tables.scores.all(), is_here).empty()) continue;
    const std::string how = fmt::format(
        "Torque noise {} N·m, accelerometer noise {} m/s², {}{}.", cell.torque, cell.accelerometer,
        experiments::plural(static_cast<std::size_t>(subject.experiment.noise.seeds), "noise seed"),
        experiments::setup_caption(subject.experiment));
    std::string tables;
    for (const experiments::CaptionedTable& table :
         experiments::paper_tables(subject.experiment, subject.tables, cell, how)) {
      tables += with_engine_titles(table);
    }
    experiments::CaptionedTable compared =
        experiments::difference_text_table(subject.experiment, subject.tables, cell);
    compared.caption =
        "Paired differences: both estimators processed the same runs with the same noise. " + how;
    if (!compared.table.rows.empty()) tables += with_engine_titles(compared);
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
