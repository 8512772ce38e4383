#include "experiments/results/scores.hpp"

#include <algorithm>

#include <tbb/parallel_for.h>

namespace touchdown::experiments {

namespace {

/// The columns that all tables of scores have: engine, estimator, noise.
template <typename Summary>
Columns<Summary> setting_columns() {
  return Columns<Summary>()
      .text("simulator", [](const Summary& s) { return s.condition.test_simulator; })
      .text("estimator", [](const Summary& s) { return s.condition.estimator; })
      .part(&Summary::cell, noise_columns());
}

using CountOf = std::int64_t (*)(const scoring::Score&);

/// Columns: the setting and the view, then metrics with their intervals, then counts.
Columns<ScoreSummary> columns_of(const std::vector<std::string>& metrics,
                                 const std::vector<std::pair<std::string, CountOf>>& counts) {
  Columns<ScoreSummary> columns = setting_columns<ScoreSummary>();
  columns.text("view", &ScoreSummary::view);
  for (const std::string& name : metrics) {
    columns.interval(name, [name](const ScoreSummary& summary) { return summary[name]; });
  }
  for (const auto& [name, count] : counts) {
    columns.count(name, [count = count](const ScoreSummary& s) { return count(s.total); });
  }
  return columns;
}

/// `reliability.csv`: a row per bin of the calibration.
void write_reliability(const std::vector<ScoreSummary>& scores, const RunDirectory& directory) {
  struct Row {
    const ScoreSummary* summary;
    std::size_t bin;
  };
  std::vector<Row> rows;
  for (const ScoreSummary& summary : scores) {
    for (std::size_t b = 0; b < scoring::Calibration::bins; ++b) rows.push_back({&summary, b});
  }
  const auto counts = [](const Row& row) -> const scoring::Calibration::Bin& {
    return row.summary->total.calibration.bin[row.bin];
  };
  const auto columns =
      Columns<Row>()
          .part([](const Row& row) -> const ScoreSummary& { return *row.summary; },
                columns_of({}, {}))
          .number("bin", &Row::bin)
          .count("steps", [counts](const Row& row) { return counts(row).points; })
          .metric("mean_probability",
                  [counts](const Row& row) { return counts(row).mean_probability(); })
          .interval("contact_frequency",
                    [](const Row& row) { return row.summary->contact_frequency[row.bin]; });
  directory.write_table("reliability.csv", columns, rows);
}

/// `differences.csv`: a row per pair of estimators and metric.
void write_differences(const std::vector<Difference>& differences, const RunDirectory& directory) {
  struct Row {
    const Difference* pair;
    std::size_t metric;  ///< in the order of `metrics()`
  };
  std::vector<Row> rows;
  for (const Difference& difference : differences) {
    for (std::size_t m = 0; m < scoring::metrics().size(); ++m) rows.push_back({&difference, m});
  }
  const auto columns =
      Columns<Row>()
          .text("simulator", [](const Row& row) { return row.pair->simulator; })
          .part([](const Row& row) { return row.pair->cell; }, noise_columns())
          .text("first", [](const Row& row) { return row.pair->first; })
          .text("second", [](const Row& row) { return row.pair->second; })
          .text("metric", [](const Row& row) { return scoring::metrics()[row.metric].name; })
          .interval("difference", [](const Row& row) { return row.pair->metric[row.metric]; });
  directory.write_table("differences.csv", columns, rows);
}

}  // namespace

Columns<noise::NoiseCell> noise_columns() {
  return Columns<noise::NoiseCell>()
      .level("torque_noise_nm", &noise::NoiseCell::torque)
      .level("accelerometer_noise_mps2", &noise::NoiseCell::accelerometer);
}

Columns<noise::NoiseCell> knee_wheel_columns() {
  return Columns<noise::NoiseCell>()
      .level("knee_noise_nm", &noise::NoiseCell::knee)
      .level("wheel_noise_nm", &noise::NoiseCell::wheel);
}

const PointMetric& mapped_metric(const Experiment& experiment) {
  return *std::ranges::find(point_metrics, experiment.figures.heatmap,
                            [](const PointMetric& metric) { return std::string(metric.name); });
}

std::vector<CellSummary> summarise(const std::vector<ConditionCounts>& counts,
                                   const std::vector<noise::NoiseCell>& cells,
                                   const scoring::BootstrapConfig& bootstrap_config) {
  std::vector<std::function<double(const scoring::Classification&)>> statistics;
  for (const PointMetric& metric : point_metrics) statistics.emplace_back(metric.of);
  std::vector<CellSummary> summaries(counts.size() * cells.size());
  tbb::parallel_for(std::size_t{0}, summaries.size(), [&](std::size_t i) {
    const ConditionCounts& condition = counts[i / cells.size()];
    const std::vector<scoring::Classification>& samples = condition.samples[i % cells.size()];
    const std::vector<Interval> intervals =
        scoring::bootstrap<scoring::Classification>(samples, statistics, bootstrap_config);
    CellSummary& summary = summaries[i];
    summary.condition = condition.condition;
    summary.cell = cells[i % cells.size()];
    for (std::size_t m = 0; m < point_metrics.size(); ++m) {
      summary.*point_metrics[m].interval = intervals[m];
    }
    const scoring::Classification all = scoring::sum(samples);
    summary.always_contact = scoring::ratio(all.contact(), all.points());
  });
  return summaries;
}

void write_score_tables(const std::vector<CellSummary>& cells,
                        const std::vector<ScoreSummary>& scores,
                        const std::vector<Difference>& differences, const RunDirectory& directory) {
  using scoring::Score;
  directory.write_table("success.csv",
                        setting_columns<CellSummary>()
                            .interval("success", &CellSummary::success)
                            .metric("always_contact_success", &CellSummary::always_contact)
                            .part(&CellSummary::cell, knee_wheel_columns()),
                        cells);
  Columns<CellSummary> classification = setting_columns<CellSummary>();
  for (const PointMetric& metric : point_metrics) {
    if (metric.interval == &CellSummary::success) continue;
    classification.interval(metric.name, metric.interval);
  }
  classification.part(&CellSummary::cell, knee_wheel_columns());
  directory.write_table("classification.csv", classification, cells);
  directory.write_table(
      "ranking.csv",
      columns_of({"event_f1", "extra_switches_per_minute", "long_errors_s_per_minute",
                  "takeoff_latency_median_ms", "landing_latency_median_ms", "no_contact_precision",
                  "balanced_accuracy"},
                 {{"true_events", [](const Score& s) { return s.events.truth; }},
                  {"decided_events", [](const Score& s) { return s.events.decided; }},
                  {"matched_events", [](const Score& s) { return s.events.matched; }}}),
      scores);
  directory.write_table(
      "views.csv",
      columns_of({"success", "contact_precision", "contact_recall", "no_contact_precision",
                  "no_contact_recall"},
                 {{"contact_steps", [](const Score& s) { return s.points.contact(); }},
                  {"no_contact_steps", [](const Score& s) { return s.points.flight(); }}}),
      scores);
  directory.write_table(
      "transitions.csv",
      columns_of({"takeoff_precision", "takeoff_recall", "landing_precision", "landing_recall",
                  "false_takeoffs_per_minute"},
                 {{"takeoffs", [](const Score& s) { return s.takeoff.events; }},
                  {"false_takeoffs", [](const Score& s) { return s.takeoff.false_alarms; }},
                  {"landings", [](const Score& s) { return s.landing.events; }},
                  {"false_landings", [](const Score& s) { return s.landing.false_alarms; }}}),
      scores);
  directory.write_table(
      "latency.csv",
      columns_of({"takeoff_latency_ms", "takeoff_latency_deviation_ms", "landing_latency_ms",
                  "landing_latency_deviation_ms"},
                 {{"takeoffs_detected", [](const Score& s) { return s.takeoff.detected; }},
                  {"landings_detected", [](const Score& s) { return s.landing.detected; }}}),
      scores);
  directory.write_table(
      "calibration.csv",
      columns_of({"brier"}, {{"steps", [](const Score& s) { return s.calibration.points; }}}),
      scores);
  write_reliability(scores, directory);
  write_differences(differences, directory);
}

}  // namespace touchdown::experiments
