#include "experiments/results/scores.hpp"

#include <algorithm>
#include <deque>
#include <functional>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/rows.hpp"
#include "experiments/evaluation/query.hpp"

namespace touchdown::experiments {

namespace {

using scoring::Score;
using ScoreRow = Scored<Score>;

Table cells_of(const ScoreRows& rows, const scoring::BootstrapConfig& bootstrap) {
  using Row = Scored<scoring::Classification>;
  Query<scoring::Classification> query;
  query.by = setting_keys<scoring::Classification>().part(
      [](const Row& row) -> const noise::NoiseCell& { return *row.noise; }, knee_wheel_columns());
  for (const PointMetric& metric : point_metrics) {
    query.statistics.push_back({metric.name, metric.of});
  }
  query.totals.metric("always_contact_success", [](const scoring::Classification& all) {
    return scoring::ratio(all.contact(), all.points());
  });
  return answer(where(rows.counted, is_own<scoring::Classification>), query, bootstrap).table;
}

/// A row for each view of each score of the experiment's own fits, by noise setting first.
std::vector<ScoreRow> rows_by_view(const std::vector<Scored<scoring::RobotScore>>& robots) {
  std::vector<ScoreRow> rows;
  for (const Scored<scoring::RobotScore>& robot : robots) {
    if (!is_own(robot)) continue;
    for (std::size_t view = 0; view < scoring::scored_views().size(); ++view) {
      rows.push_back({robot.run, robot.segment, robot.condition, robot.noise, view,
                      scoring::score_of_view(robot.score, view)});
    }
  }
  std::ranges::stable_sort(rows, {}, &ScoreRow::noise);
  return rows;
}

const std::string& view_of(std::size_t item) { return scoring::scored_views()[item]; }

Answer<Score> scores_of(const std::vector<ScoreRow>& rows,
                        const scoring::BootstrapConfig& bootstrap) {
  Query<Score> query;
  query.by =
      setting_keys<Score>().text("view", [](const ScoreRow& row) { return view_of(row.item); });
  for (const scoring::Metric& metric : scoring::metrics()) {
    query.statistics.push_back({metric.name, metric.of, metric.events});
  }
  query.totals.count("true_events", [](const Score& s) { return s.events.truth; })
      .count("decided_events", [](const Score& s) { return s.events.decided; })
      .count("matched_events", [](const Score& s) { return s.events.matched; })
      .count("contact_steps", [](const Score& s) { return s.points.contact(); })
      .count("no_contact_steps", [](const Score& s) { return s.points.flight(); })
      .count("takeoffs", [](const Score& s) { return s.takeoff.events; })
      .count("false_takeoffs", [](const Score& s) { return s.takeoff.false_alarms; })
      .count("landings", [](const Score& s) { return s.landing.events; })
      .count("false_landings", [](const Score& s) { return s.landing.false_alarms; })
      .count("takeoffs_detected", [](const Score& s) { return s.takeoff.detected; })
      .count("landings_detected", [](const Score& s) { return s.landing.detected; })
      .count("steps", [](const Score& s) { return s.calibration.points; });
  return answer(rows, query, bootstrap);
}

Table reliability_of(const std::vector<ScoreRow>& rows, const scoring::BootstrapConfig& bootstrap) {
  using Bin = scoring::Calibration::Bin;
  constexpr std::size_t bins = scoring::Calibration::bins;
  std::vector<Scored<Bin>> by_bin;
  for (const ScoreRow& row : rows) {
    for (std::size_t b = 0; b < bins; ++b) {
      by_bin.push_back({row.run, row.segment, row.condition, row.noise, row.item * bins + b,
                        row.score.calibration.bin[b]});
    }
  }
  Query<Bin> query;
  query.by = setting_keys<Bin>()
                 .text("view", [](const Scored<Bin>& row) { return view_of(row.item / bins); })
                 .number("bin", [](const Scored<Bin>& row) { return row.item % bins; });
  query.statistics = {{"contact_frequency", &Bin::contact_frequency}};
  query.totals.count("steps", &Bin::points).metric("mean_probability", &Bin::mean_probability);
  return answer(by_bin, query, bootstrap).table;
}

using Names = std::vector<std::string>;

Names with_setting(const Names& columns) {
  Names all = {"simulator", "estimator", "torque_noise_nm", "accelerometer_noise_mps2"};
  all.insert(all.end(), columns.begin(), columns.end());
  return all;
}

/// Bins before and after which nothing changes are left out, but for the first and the last one of
/// all rows: so are curves as long as each other, also of those who find nothing.
Table latencies_of(const Answer<Score>& scores) {
  using scoring::LatencyHistogram;
  Table table = select(scores.table, with_setting({"view"}));
  const std::vector<std::vector<Cell>> settings = std::exchange(table.rows, {});
  table.columns.push_back({"latency_ms", ColumnRole::key, ColumnType::exact});
  for (const char* found : {"takeoffs_found", "landings_found"}) {
    table.columns.push_back({found, ColumnRole::metric, ColumnType::measured});
  }
  LatencyHistogram all;
  for (const Score& total : scores.totals) {
    all += total.takeoff.latency;
    all += total.landing.latency;
  }
  std::size_t first = 6, last = 22;  // from -30 to 50 ms, or more
  for (std::size_t b = 0; b < LatencyHistogram::bins; ++b) {
    if (all.events[b] == 0) continue;
    first = std::min(first, b > 0 ? b - 1 : 0);
    last = std::max(last, b);
  }
  for (std::size_t i = 0; i < settings.size(); ++i) {
    if (TableRow(scores.table, i).text("view") != scoring::scored_views().front()) continue;
    const auto& [takeoff, landing] = std::tie(scores.totals[i].takeoff, scores.totals[i].landing);
    LatencyHistogram both = takeoff.latency;
    both += landing.latency;
    Share takeoffs{0, takeoff.events}, landings{0, landing.events};
    for (std::size_t b = 0; b < LatencyHistogram::bins; ++b) {
      takeoffs.part += takeoff.latency.events[b];
      landings.part += landing.latency.events[b];
      const bool is_shown =
          b == first || b == last || both.events[b] > 0 || (b < last && both.events[b + 1] > 0);
      if (!is_shown) continue;
      std::vector<Cell>& row = table.rows.emplace_back(settings[i]);
      row.emplace_back(LatencyHistogram::centre_ms(b) + 0.5e-3 * LatencyHistogram::width_us);
      for (const Share& found : {takeoffs, landings}) row.emplace_back(rounded(found.value()));
    }
  }
  return table;
}

Table differences_of(const std::vector<ScoreRow>& rows, const scoring::BootstrapConfig& bootstrap) {
  struct Line {
    const ScoreRow* of;
    std::vector<Score> samples;
  };
  struct Pair {
    const Line* first;
    const Line* second;
    std::vector<Interval> difference = {};  ///< by metric
  };
  const auto setting = [](const ScoreRow* row) {
    return std::pair(row->noise, row->condition->test_simulator);
  };
  std::vector<const ScoreRow*> wheels;
  for (const ScoreRow& row : rows) {
    if (row.item == 0) wheels.push_back(&row);
  }
  std::deque<Line> lines;  // pairs refer to them
  std::vector<Pair> pairs;
  for (const auto& alike : group_by(wheels, setting)) {
    const Line* first = nullptr;
    for (const auto& own : group_by(alike.rows, &ScoreRow::condition)) {
      lines.push_back({own.rows.front(), samples_of(own.rows)});
      if (first != nullptr) pairs.push_back({first, &lines.back()});
      if (first == nullptr) first = &lines.back();
    }
  }
  std::vector<std::function<double(const Score&)>> statistics;
  for (const scoring::Metric& metric : scoring::metrics()) statistics.push_back(metric.of);
  tbb::parallel_for(std::size_t{0}, pairs.size(), [&](std::size_t i) {
    pairs[i].difference = scoring::bootstrap_differences(
        pairs[i].first->samples, pairs[i].second->samples, statistics, bootstrap);
  });
  using Row = std::pair<const Pair*, std::size_t>;  // and a metric
  std::vector<Row> by_metric;
  for (const Pair& pair : pairs) {
    for (std::size_t m = 0; m < statistics.size(); ++m) by_metric.emplace_back(&pair, m);
  }
  return Columns<Row>()
      .text("simulator",
            [](const Row& row) { return row.first->first->of->condition->test_simulator; })
      .part([](const Row& row) { return *row.first->first->of->noise; }, noise_columns())
      .text("first", [](const Row& row) { return row.first->first->of->condition->estimator; })
      .text("second", [](const Row& row) { return row.first->second->of->condition->estimator; })
      .text("metric", [](const Row& row) { return scoring::metrics()[row.second].name; })
      .interval("difference", [](const Row& row) { return row.first->difference[row.second]; })
      .table(by_metric);
}

/// A file of some columns of one of the tables.
struct Print {
  const char* file;
  Table ScoreTables::*table;
  Names columns;
};

std::vector<Print> prints() {
  return {
      {"success.csv", &ScoreTables::cells,
       with_setting({"success", "always_contact_success", "knee_noise_nm", "wheel_noise_nm"})},
      {"classification.csv", &ScoreTables::cells,
       with_setting({"contact_precision", "contact_recall", "no_contact_precision",
                     "no_contact_recall", "balanced_accuracy", "knee_noise_nm", "wheel_noise_nm"})},
      {"ranking.csv", &ScoreTables::scores,
       with_setting({"view", "event_f1", "extra_switches_per_minute", "long_errors_s_per_minute",
                     "takeoff_latency_median_ms", "landing_latency_median_ms",
                     "no_contact_precision", "balanced_accuracy", "true_events", "decided_events",
                     "matched_events"})},
      {"views.csv", &ScoreTables::scores,
       with_setting({"view", "success", "contact_precision", "contact_recall",
                     "no_contact_precision", "no_contact_recall", "contact_steps",
                     "no_contact_steps"})},
      {"transitions.csv", &ScoreTables::scores,
       with_setting({"view", "takeoff_precision", "takeoff_recall", "landing_precision",
                     "landing_recall", "false_takeoffs_per_minute", "takeoffs", "false_takeoffs",
                     "landings", "false_landings"})},
      {"latency.csv", &ScoreTables::scores,
       with_setting({"view", "takeoff_latency_ms", "takeoff_latency_deviation_ms",
                     "landing_latency_ms", "landing_latency_deviation_ms", "takeoffs_detected",
                     "landings_detected"})},
      {"calibration.csv", &ScoreTables::scores, with_setting({"view", "brier", "steps"})},
      {"reliability.csv", &ScoreTables::reliability,
       with_setting({"view", "bin", "steps", "mean_probability", "contact_frequency"})},
      {"latencies.csv", &ScoreTables::latencies, {}},
      {"differences.csv", &ScoreTables::differences, {}}};
}

}  // namespace

const PointMetric& mapped_metric(const Experiment& experiment) {
  return *std::ranges::find(point_metrics, experiment.figures.heatmap,
                            [](const PointMetric& metric) { return std::string(metric.name); });
}

ScoreTables score_tables(const ScoreRows& all, const scoring::BootstrapConfig& bootstrap) {
  const std::vector<ScoreRow> rows = rows_by_view(all.scored);
  const Answer<Score> scores = scores_of(rows, bootstrap);
  return {.cells = cells_of(all, bootstrap),
          .scores = scores.table,
          .reliability = reliability_of(rows, bootstrap),
          .latencies = latencies_of(scores),
          .differences = differences_of(rows, bootstrap)};
}

void write_score_tables(const ScoreTables& tables, const RunDirectory& directory) {
  directory.write_table("runs.csv", tables.runs);
  for (const Print& print : prints()) {
    const Table& table = tables.*print.table;
    directory.write_measured(print.file,
                             print.columns.empty() ? table : select(table, print.columns));
  }
}

ScoreTables read_score_tables(const std::filesystem::path& run_directory) {
  const auto read = [&](const char* name) {
    const std::filesystem::path file = run_directory / "tables" / name;
    if (!is_there(file)) {
      throw InputError(fmt::format(
          "{}: is not finished, or was made by an older touchdown: it has no tables/{}; run "
          "`touchdown run` again",
          run_directory.string(), name));
    }
    return table_of(from_csv(read_file(file)));
  };
  ScoreTables tables{.runs = read("runs.csv")};
  for (const Print& print : prints()) {
    Table& whole = tables.*print.table;
    const bool is_alone = print.columns.empty();  // a run of an older version may lack it
    if (is_alone && !is_there(run_directory / "tables" / print.file)) continue;
    const Table part = read(print.file);
    if (!whole.columns.empty() && whole.rows.size() != part.rows.size()) {
      throw InputError(fmt::format(
          "{}: tables/{}: has {} rows, expected {} as in the other tables of the same scores",
          run_directory.string(), print.file, part.rows.size(), whole.rows.size()));
    }
    add_columns(whole, part);
  }
  return tables;
}

bool is_at(const TableRow& row, const noise::NoiseCell& cell) {
  return row.number("torque_noise_nm") == cell.torque &&
         row.number("accelerometer_noise_mps2") == cell.accelerometer;
}

bool loses(const TableRow& cell) {
  return cell.number("success") <= cell.number("always_contact_success");
}

bool is_silent(const TableRow& cell) { return cell.number("no_contact_recall") < 0.02; }

bool is_scored(const TableRow& run) {
  const std::string outcome = run.text("outcome");
  return outcome != "error" && !is_failure(logs::outcome_from_text(outcome));
}

}  // namespace touchdown::experiments
