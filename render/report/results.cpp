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

/// "a", "a and b", "a, b and c".
std::string in_words(const std::vector<std::string>& things) {
  std::string text;
  for (std::size_t i = 0; i < things.size(); ++i) {
    if (i > 0) text += i + 1 == things.size() ? " and " : ", ";
    text += things[i];
  }
  return text;
}

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

Json with_engine_titles(experiments::CaptionedTable table) {
  for (auto& row : table.table.rows) row[0] = simulators::simulator_title(row[0]);
  return table_members(table, 2);
}

/// A paragraph per engine: the estimator with the highest F1 at each highlighted noise setting, and
/// those of the next two. Empty without scores.
Json findings(const ReportSubject& subject) {
  Json paragraphs = Json::array();
  for (const std::string& simulator : subject.experiment.simulators) {
    std::string text;
    for (const noise::NoiseCell& noise : subject.experiment.highlights) {
      const Scores scores = ranked(subject.tables.scores, simulator, noise);
      if (!scores.empty()) text += finding(subject.experiment, noise, scores);
    }
    if (text.empty()) continue;
    text.pop_back();
    paragraphs.push_back({{"engine", simulators::simulator_title(simulator)}, {"text", text}});
  }
  return paragraphs;
}

}  // namespace

ReportSection estimators_section(const ReportSubject& subject) {
  Json estimators = Json::array();
  for (const std::string& name : subject.experiment.estimators) {
    const experiments::EstimatorEntry& entry =
        experiments::estimator_entry(subject.experiment, name);
    estimators.push_back({{"title", entry.title},
                          {"summary", entry.summary},
                          {"inputs", inputs_text(entry.sensors)}});
  }
  return {"estimators", "Estimators",
          html_of("estimators.html", {{"estimators", std::move(estimators)}})};
}

PageHeader report_header(const ReportSubject& subject) {
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
  bool is_noisy = false;
  for (const TableRow& cell : subject.tables.cells.all()) {
    settings.insert({cell.number("accelerometer_noise_mps2"), cell.number("knee_noise_nm"),
                     cell.number("wheel_noise_nm")});
    is_noisy = is_noisy || *settings.rbegin() != std::array{0.0, 0.0, 0.0};
  }
  std::string note = fmt::format(
      "Film, replay and latencies count each wheel's flights of at least {:.0f} ms. {}",
      1e3 * experiment.scoring.minimum_flight, experiments::conditions_text(experiment));
  if (unusable > 0) {
    note += fmt::format(" {} test {} fell, diverged or could not be simulated and {} not scored.",
                        unusable, unusable == 1 ? "run" : "runs", unusable == 1 ? "is" : "are");
  }
  return {experiment.name,
          fmt::format("Is each wheel in contact with the ground? {} {} it from joint torques and "
                      "an accelerometer, in {}{}.",
                      experiments::plural(experiment.estimators.size(), "estimator"),
                      experiment.estimators.size() == 1 ? "estimates" : "estimate",
                      in_words(engines_of(experiment)), is_noisy ? ", under sensor noise" : ""),
          {{"physics engines", std::to_string(experiment.simulators.size())},
           {"test runs scored", std::to_string(test_runs)},
           {"flights of both wheels at once", fmt::format("{:.0f}", flights)},
           {"flights of one wheel alone", fmt::format("{:.0f}", of_one_wheel)},
           {"noise settings", std::to_string(settings.size())},
           {"noise seeds per run", std::to_string(experiment.noise.seeds)}},
          note};
}

ReportSection results_section(const ReportSubject& subject) {
  const experiments::Experiment& experiment = subject.experiment;
  if (subject.tables.cells.rows.empty()) return {"results", "Results"};
  Json tables = Json::array();
  for (const noise::NoiseCell& cell : experiment.highlights) {
    const experiments::CaptionedTable table{
        fmt::format(
            "F1 of takeoffs and landings within 20 ms, decided switches that detect none of them, "
            "per "
            "minute and wheel, and the mean recall of contact and air, with torque noise of {} N·m "
            "and accelerometer noise of {} m/s². “Always contact” is the constant answer{}.",
            cell.torque, cell.accelerometer, experiments::setup_caption(experiment)),
        fmt::format("F1 at {} N·m and {} m/s²", cell.torque, cell.accelerometer),
        experiments::accuracy_table(experiment, subject.tables, cell, engines_of(experiment))};
    tables.push_back(table_members(table, 1));
  }
  return {"results", "Results",
          html_of("results.html", {{"findings", findings(subject)},
                                   {"notes", experiments::score_notes(experiment, subject.tables)},
                                   {"tables", std::move(tables)}})};
}

ReportSection paper_section(const ReportSubject& subject) {
  Json cells = Json::array();
  bool has_paper = false;
  for (const noise::NoiseCell& cell : subject.experiment.highlights) {
    const auto is_here = [&](const TableRow& row) { return experiments::is_at(row, cell); };
    if (where(subject.tables.scores.all(), is_here).empty()) continue;
    const std::string how = fmt::format(
        "Torque noise {} N·m, accelerometer noise {} m/s², {}{}.", cell.torque, cell.accelerometer,
        experiments::plural(static_cast<std::size_t>(subject.experiment.noise.seeds), "noise seed"),
        experiments::setup_caption(subject.experiment));
    Json tables = Json::array();
    for (const experiments::CaptionedTable& table :
         experiments::paper_tables(subject.experiment, subject.tables, cell, how)) {
      has_paper = has_paper || table.table.header.back() == experiments::paper_column;
      tables.push_back(with_engine_titles(table));
    }
    experiments::CaptionedTable compared =
        experiments::difference_text_table(subject.experiment, subject.tables, cell);
    compared.caption =
        "Paired differences: both estimators processed the same runs with the same noise. " + how;
    if (!compared.table.rows.empty()) tables.push_back(with_engine_titles(compared));
    cells.push_back({{"is_first", cells.empty()},
                     {"torque", fmt::format("{}", cell.torque)},
                     {"accelerometer", fmt::format("{}", cell.accelerometer)},
                     {"tables", std::move(tables)}});
  }
  ReportSection section{"paper", "The paper's metrics"};
  if (cells.empty()) return section;
  section.html =
      html_of("paper.html", {{"conditions", experiments::conditions_text(subject.experiment)},
                             {"has_paper", has_paper},
                             {"cells", std::move(cells)}});
  return section;
}

}  // namespace touchdown::render
