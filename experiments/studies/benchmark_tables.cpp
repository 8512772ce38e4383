#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/files.hpp"
#include "core/rows.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/results/captions.hpp"
#include "experiments/results/scores.hpp"
#include "experiments/studies/benchmark.hpp"

namespace touchdown::experiments {

namespace {

/// ".989", "1".
std::string share_text(double share) {
  if (std::isnan(share)) return "–";
  const std::string text = fmt::format("{:.3f}", share);
  return text.starts_with("0.") ? text.substr(1) : text == "1.000" ? "1" : text;
}

std::string share_text(const Interval& share) {
  if (std::isnan(share.low) || std::isnan(share.high)) return share_text(share.estimate);
  return fmt::format("{} [{}, {}]", share_text(share.estimate), share_text(share.low),
                     share_text(share.high));
}

std::string header_of(const noise::NoiseCell& noise) {
  if (noise.levels() == noise::SensorNoise{}) return "no added noise";
  return noise.knee == noise.wheel ? fmt::format("{} N·m, {} m/s²", noise.knee, noise.accelerometer)
                                   : fmt::format("knee {} N·m, wheel {} N·m, {} m/s²", noise.knee,
                                                 noise.wheel, noise.accelerometer);
}

const Standings::Entry* entry_called(const std::string& estimator, const Standings& standings) {
  const auto found = std::ranges::find(standings.entries, estimator, &Standings::Entry::estimator);
  return found == standings.entries.end() ? nullptr : &*found;
}

/// Those of `benchmark.table`, or all that are ranked, the best first.
std::vector<std::string> estimators_of(const Standings& first, const Experiment& experiment) {
  std::vector<std::string> all = experiment.studies.at<BenchmarkConfig>().table;
  if (!all.empty()) return all;
  for (const Standings::Entry& entry : first.entries) {
    all.push_back(entry.estimator);
  }
  return all;
}

/// What estimators are ranked by, after F1; the last is their balanced accuracy.
std::array<std::string, 6> ranking_texts(const scoring::Score& score, std::string accuracy) {
  const auto shown = [](const char* format, double value) {
    return std::isnan(value) ? "–" : fmt::format(fmt::runtime(format), value);
  };
  return {shown("{:.1f}", score.extra_switches_per_minute()),
          shown("{:.2f}", score.long_errors_s_per_minute()),
          shown("{:+.1f}", score.events.takeoff.median()),
          shown("{:+.1f}", score.events.landing.median()),
          shown("{:.3f}", score.points.no_contact_precision()),
          std::move(accuracy)};
}

}  // namespace

std::string unseen_markdown(const std::vector<Standings>& unseen, const Experiment& experiment) {
  if (unseen.empty()) return {};
  const Standings& first = unseen.front();
  std::vector<const Standings*> settings;
  for (const Standings& one : unseen) {
    if (one.robot == first.robot && one.sensors == first.sensors) settings.push_back(&one);
  }
  std::string text = "| estimator |";
  std::string line = "|---|";
  for (const Standings* one : settings) {
    text += fmt::format(" F1, {} |", header_of(one->noise));
    line += "---|";
  }
  text +=
      " extra switches a minute | long errors (s a minute) | takeoff (ms) | landing (ms) | "
      "precision of air | balanced accuracy |\n" +
      line + "---|---|---|---|---|---|\n";
  for (const std::string& estimator : estimators_of(first, experiment)) {
    std::string f1;
    std::array<std::vector<std::string>, 6> others;
    for (const Standings* one : settings) {
      const Standings::Entry* entry = entry_called(estimator, *one);
      f1 += fmt::format(" {} |", entry == nullptr ? "–" : share_text(entry->event_f1));
      const std::array<std::string, 6> texts =
          entry == nullptr ? std::array<std::string, 6>{"–", "–", "–", "–", "–", "–"}
                           : ranking_texts(entry->score, share_text(entry->mean));
      for (std::size_t i = 0; i < texts.size(); ++i) others[i].push_back(texts[i]);
    }
    text += fmt::format("| `{}` |{}", estimator, f1);
    for (const auto& texts : others) text += fmt::format(" {} |", fmt::join(texts, " / "));
    text += '\n';
  }
  return text;
}

namespace {

/// What estimators are ranked by, after F1.
Columns<scoring::Score> after_f1_columns() {
  using scoring::Score;
  return Columns<Score>()
      .metric("extra_switches_per_minute", &Score::extra_switches_per_minute)
      .metric("long_errors_s_per_minute", &Score::long_errors_s_per_minute)
      .metric("takeoff_latency_median_ms", [](const Score& s) { return s.events.takeoff.median(); })
      .metric("landing_latency_median_ms", [](const Score& s) { return s.events.landing.median(); })
      .metric("no_contact_precision",
              [](const Score& s) { return s.points.no_contact_precision(); });
}

Columns<scoring::Score> ranking_columns() {
  return Columns<scoring::Score>()
      .metric("event_f1", [](const scoring::Score& s) { return s.events.f1(); })
      .part([](const scoring::Score& s) -> const scoring::Score& { return s; }, after_f1_columns());
}

Columns<BenchmarkRow> row_columns(double level) {
  using Row = BenchmarkRow;
  return Columns<Row>()
      .text("simulator", &Row::simulator)
      .text("robot", &Row::robot)
      .text("sensors", &Row::sensors)
      .text("scene", &Row::scene)
      .text("split", &Row::split)
      .text("estimator", &Row::estimator)
      .part(&Row::score, ranking_columns())
      .interval("balanced_accuracy",
                [level](const Row& row) { return interval_of(row.balanced_accuracy, level); })
      .metric("no_contact_recall", [](const Row& r) { return r.score.points.no_contact_recall(); })
      .metric("calibration_error",
              [](const Row& r) { return r.score.calibration.expected_error(); })
      .metric(
          "log_loss",
          [](const Row& r) { return r.extended.log_loss / static_cast<double>(r.extended.steps); })
      .metric("success", [](const Row& r) { return r.score.points.success(); })
      .metric("loaded_balanced_accuracy",
              [](const Row& r) { return r.extended.loaded.balanced_accuracy(); })
      .metric("false_takeoffs_per_minute",
              [](const Row& r) { return r.score.false_takeoffs_per_minute(); })
      .part(&Row::noise, noise_columns())
      .number("air_s", &Row::air)
      .is(ColumnRole::note)
      .count("takeoffs", [](const Row& r) { return r.score.takeoff.events; })
      .runs("runs", &Row::runs)
      .count("failed", &Row::failed)
      .text("fitted_on", &Row::fitted_on)
      .number("refits", &Row::refits)
      .is(ColumnRole::note);
}

/// The first columns of the two tables below.
Columns<Standings> setup_columns() {
  return Columns<Standings>()
      .text("robot", &Standings::robot)
      .text("sensors", &Standings::sensors)
      .part(&Standings::noise, noise_columns());
}

template <typename Part>
struct PartOfStandings {
  const Standings* all;
  const Part* part;
};

template <typename Part>
std::vector<PartOfStandings<Part>> parts_of(const std::vector<Standings>& all,
                                            std::vector<Part> Standings::*list) {
  std::vector<PartOfStandings<Part>> parts;
  for (const Standings& standings : all) {
    for (const Part& part : standings.*list) parts.push_back({&standings, &part});
  }
  return parts;
}

template <typename Part>
Columns<PartOfStandings<Part>> with_setup(const Columns<Part>& columns) {
  using Row = PartOfStandings<Part>;
  return Columns<Row>()
      .part([](const Row& row) -> const Standings& { return *row.all; }, setup_columns())
      .part([](const Row& row) -> const Part& { return *row.part; }, columns);
}

Columns<Standings::Entry> entry_columns() {
  using Entry = Standings::Entry;
  return Columns<Entry>()
      .text("estimator", &Entry::estimator)
      .interval("event_f1", &Entry::event_f1)
      .part(&Entry::score, after_f1_columns())
      .interval("mean_balanced_accuracy", &Entry::mean)
      .metric("worst_balanced_accuracy", &Entry::worst)
      .text("worst_scene", &Entry::worst_scene)
      .is(ColumnRole::note)
      .text("worst_simulator", &Entry::worst_simulator)
      .is(ColumnRole::note)
      .flag("is_not_significantly_worse", &Entry::is_not_significantly_worse)
      .metric("log_loss_bits", &Entry::log_loss)
      .number("scored_scenes", &Entry::scored)
      .is(ColumnRole::note)
      .number("planned_scenes", &Entry::planned)
      .is(ColumnRole::note)
      .number("scenes_without_air", &Entry::without_air)
      .is(ColumnRole::note);
}

Columns<Standings::Difference> pair_columns() {
  using Difference = Standings::Difference;
  return Columns<Difference>()
      .text("scene", &Difference::scene)
      .text("first", &Difference::first)
      .text("second", &Difference::second)
      .interval("difference", &Difference::value);
}

/// The loads of one estimator, fitted on its own setup, over all scenes and engines.
struct LoadRow {
  const BenchmarkRow* setting;
  scoring::LoadScore load;
};

std::vector<LoadRow> load_rows(const std::vector<BenchmarkRow>& rows) {
  std::vector<const BenchmarkRow*> own;
  for (const BenchmarkRow& row : rows) {
    if (row.fitted_on == "own") own.push_back(&row);
  }
  std::vector<LoadRow> all;
  for (const auto& alike : group_by(own, [](const BenchmarkRow* row) {
         return std::tuple(row->robot, row->sensors, row->noise, row->estimator);
       })) {
    LoadRow sum{alike.rows.front(), {}};
    for (const BenchmarkRow* row : alike.rows) sum.load += row->extended.load;
    if (sum.load.known() > 0) all.push_back(sum);
  }
  return all;
}

Columns<LoadRow> load_columns() {
  using Row = LoadRow;
  return Columns<Row>()
      .text("robot", [](const Row& row) { return row.setting->robot; })
      .text("sensors", [](const Row& row) { return row.setting->sensors; })
      .part([](const Row& row) -> const noise::NoiseCell& { return row.setting->noise; },
            noise_columns())
      .text("estimator", [](const Row& row) { return row.setting->estimator; })
      .metric("load_error_median_n", [](const Row& row) { return row.load.median_error(); })
      .metric("load_coverage", [](const Row& row) { return row.load.coverage(); })
      .metric("load_share", [](const Row& row) { return row.load.share(); });
}

/// Rows: estimators. Columns: scenes, then the mean and the worst scene of estimators that were
/// scored in every scene with a scored run.
TextTable scene_table(const std::vector<BenchmarkRow>& rows, const Experiment& experiment) {
  const auto shown = [](double value) {
    return std::isnan(value) ? std::string("–") : fmt::format("{:.3f}", value);
  };
  TextTable table = pivot(
      rows, [&](const BenchmarkRow& row) { return estimator_title_in(experiment, row.estimator); },
      &BenchmarkRow::scene,
      [&](const BenchmarkRow& row) { return shown(row.balanced_accuracy.estimate); });
  const std::size_t scenes = table.header.size() - 1;
  table.header.insert(table.header.end(), {"mean", "worst"});
  auto cells = table.rows.begin();
  for (const auto& scored : group_by(rows, &BenchmarkRow::estimator)) {
    double mean = 0.0;
    double worst = 1.0;
    const auto scored_rows = where(scored.rows, &BenchmarkRow::is_scored);
    const auto with_air =
        where(scored_rows, [](const BenchmarkRow& row) { return row.air >= least_air; });
    const auto& judged = with_air.empty() ? scored_rows : with_air;
    for (const BenchmarkRow& row : judged) {
      mean += row.balanced_accuracy.estimate / static_cast<double>(judged.size());
      worst = std::fmin(worst, row.balanced_accuracy.estimate);
    }
    const bool is_complete = scored.rows.size() == scenes && !scored_rows.empty();
    for (const double value : {mean, worst}) {
      cells->push_back(is_complete ? shown(value) : "–");
    }
    ++cells;
  }
  return table;
}

/// What the estimator is given; "–" for submissions.
std::string given_in(const Experiment& experiment, const std::string& estimator) {
  const EstimatorEntry* const own = find_estimator(estimator);
  if (find_estimator(estimator, experiment.external_estimators) != own) return "signals";
  return own == nullptr ? "–" : given_text(*own);
}

std::string standings_text(const Standings& standings, const Experiment& experiment) {
  TextTable table{{"", "F1", "extra switches/min", "long errors (s/min)", "takeoff (ms)",
                   "landing (ms)", "precision of air", "balanced accuracy",
                   "balanced accuracy not significantly below the best", "worst", "in", "given"},
                  {}};
  for (const Standings::Entry& entry : standings.entries) {
    std::vector<std::string>& row = table.rows.emplace_back(std::vector{
        estimator_title_in(experiment, entry.estimator), with_interval(entry.event_f1)});
    const auto texts = ranking_texts(entry.score, with_interval(entry.mean));
    row.insert(row.end(), texts.begin(), texts.end());
    row.insert(row.end(),
               {entry.is_not_significantly_worse ? "yes" : "", fmt::format("{:.3f}", entry.worst),
                fmt::format("{}, {}", entry.worst_scene, entry.worst_simulator),
                given_in(experiment, entry.estimator)});
  }
  const Standings::Entry& first = standings.entries.front();
  const std::string fewer =
      first.scored == first.planned
          ? ""
          : fmt::format(" ({} of {}: the others have no scored run)", first.scored, first.planned);
  const std::string no_air =
      first.without_air == 0
          ? ""
          : fmt::format("; {} of {} with less than 100 ms of air count in no balanced accuracy",
                        first.without_air, first.scored);
  return fmt::format("\n{}, sensors {}, {}: all scenes and engines{}{}\n{}", standings.robot,
                     standings.sensors, noise_text(standings.noise), fewer, no_air, to_text(table));
}

/// Every scene of one engine, robot, sensors and noise.
std::string scenes_text(const Standings& standings, const std::string& simulator,
                        const std::vector<BenchmarkRow>& rows, const Experiment& experiment) {
  const auto alike = where(rows, [&](const BenchmarkRow& row) {
    return row.fitted_on == "own" && row.simulator == simulator && row.robot == standings.robot &&
           row.sensors == standings.sensors && row.noise == standings.noise;
  });
  if (alike.empty()) return {};
  std::string text =
      fmt::format("\n{}, {}, sensors {}, {}\n{}", simulator, standings.robot, standings.sensors,
                  noise_text(standings.noise), to_text(scene_table(alike, experiment)));
  std::set<std::string> failures;
  std::set<std::string> unscored;
  for (const BenchmarkRow& row : alike) {
    if (row.failed == 0) continue;
    if (!row.is_scored()) unscored.insert(row.scene);
    failures.insert(fmt::format("{} of {} in {}", row.failed, row.runs, row.scene));
  }
  if (!failures.empty()) {
    text += fmt::format("Failed runs, not scored: {}\n", fmt::join(failures, ", "));
  }
  if (!unscored.empty()) {
    text +=
        fmt::format("Without a scored run, not in mean and worst: {}\n", fmt::join(unscored, ", "));
  }
  return text;
}

/// For the terminal. `unseen`: `unseen_markdown` of the second standings.
std::string text_of(const std::vector<BenchmarkRow>& rows, const std::vector<Standings>& all,
                    const std::vector<Standings>& unseen, const std::string& markdown,
                    const Experiment& experiment) {
  std::string text = fmt::format("Balanced accuracy by scene ({})\n", labels_text(experiment));
  if (all.empty()) return text + "No run was scored.\n";
  const Standings& first = all.front();
  for (const Standings& standings : all) {
    text += standings_text(standings, experiment);
    if (standings.robot != first.robot || standings.sensors != first.sensors) continue;
    for (const std::string& simulator : experiment.simulators) {
      text += scenes_text(standings, simulator, rows, experiment);
    }
  }
  if (unseen.empty()) return text;
  return text + fmt::format(
                    "\n{}, sensors {}: the {} pairs of an unseen scene and an engine "
                    "(tables/benchmark_unseen.md)\n\n{}",
                    unseen.front().robot, unseen.front().sensors,
                    unseen.front().entries.front().scored, markdown);
}

}  // namespace

/// The files: `benchmark.csv`, `benchmark_standings.csv`, `benchmark_unseen.csv`,
/// `benchmark_differences.csv`, `loads.csv` and `benchmark_unseen.md`.
std::string write_benchmark(const Evaluation& evaluation, const RunDirectory& directory) {
  const Experiment& experiment = evaluation.request.experiment;
  const scoring::BootstrapConfig& intervals = experiment.intervals.bootstrap;
  const std::vector<BenchmarkRow> rows = benchmark_rows(evaluation, directory);
  const std::vector<Standings> all = standings(rows, intervals);
  const std::vector<Standings> unseen = standings(rows, intervals, true);
  directory.write_table("benchmark.csv", row_columns(intervals.level), rows);
  directory.write_table("benchmark_standings.csv", with_setup(entry_columns()),
                        parts_of(all, &Standings::entries));
  directory.write_table("benchmark_unseen.csv", with_setup(entry_columns()),
                        parts_of(unseen, &Standings::entries));
  directory.write_table("benchmark_differences.csv", with_setup(pair_columns()),
                        parts_of(all, &Standings::differences));
  directory.write_table("loads.csv", load_columns(), load_rows(rows));
  const std::string markdown = unseen_markdown(unseen, experiment);
  if (!unseen.empty()) {
    write_atomically(directory.own_file("tables", "benchmark_unseen.md"), markdown);
  }
  return text_of(rows, all, unseen, markdown, experiment);
}

std::vector<FigureSpec> standings_figures(const Table& standings, const Experiment& experiment) {
  const FigureGroups setups =
      combinations_in(standings, {"robot", "sensors"}, [](const auto&) { return std::string(); });
  std::vector<FigureSpec> specs;
  for (const FigureGroup& setup : setups.groups) {
    const std::string &robot = setup.values[0], &sensors = setup.values[1];
    FigureSpec spec{.name = fmt::format("benchmark_{}_{}", robot, sensors),
                    .table = "benchmark_standings.csv",
                    .where = {{"robot", robot}, {"sensors", sensors}}};
    spec.panels = noise_panels(standings);
    const auto title = [&](const std::string& name) {
      return estimator_title_in(experiment, name);
    };
    spec.rows = groups_in(standings, "estimator", title, spec.where);
    spec.measures = {axis_with_interval("event_f1", "F1 of events"),
                     axis_with_interval("mean_balanced_accuracy", "balanced accuracy"),
                     {.column = "worst_balanced_accuracy", .title = "that of the worst scene"}};
    for (FigureAxis& measure : spec.measures) measure.to = 1.01;
    spec.marks = {
        {MarkShape::points},
        {MarkShape::ring, {{"is_not_significantly_worse", "1"}}, "mean_balanced_accuracy"}};
    spec.title = fmt::format("Estimators on {} with {} sensors", robot, sensors);
    spec.caption = fmt::format(
        "Over all scenes and engines, with {:.0f} % intervals: F1 of takeoffs and landings, "
        "balanced accuracy, and that of the scene and engine where it is lowest. A ring: not "
        "significantly worse than the best, because the simultaneous band of their paired "
        "difference includes zero.",
        100.0 * experiment.intervals.bootstrap.level);
    spec.alt = "Estimators by F1 of takeoffs and landings and by balanced accuracy.";
    FigureSpec one = spec;
    for (const FigureAxis& measure : spec.measures) {
      one.measures = {measure};
      spec.alt += fmt::format(" {}:{}", measure.title, values_text(one, standings));
    }
    specs.push_back(std::move(spec));
  }
  return specs;
}

}  // namespace touchdown::experiments
