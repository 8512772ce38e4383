#include "experiments/results/scores.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "experiments/estimators/registry.hpp"

namespace touchdown::experiments {

namespace {

const std::vector<std::string> setting_columns = {"simulator", "estimator", "torque_noise_nm",
                                                  "accelerometer_noise_mps2"};
const std::vector<std::string> view_columns = {"simulator", "estimator", "torque_noise_nm",
                                               "accelerometer_noise_mps2", "view"};

std::vector<std::string> setting(const Condition& condition, const noise::NoiseCell& cell) {
  return {condition.test_simulator, condition.estimator, exact(cell.torque),
          exact(cell.accelerometer)};
}

std::vector<std::string> setting(const ScoreSummary& summary) {
  std::vector<std::string> cells = setting(summary.condition, summary.cell);
  cells.push_back(summary.view);
  return cells;
}

/// Columns: the setting, then metrics with their intervals, then counts.
Table table_of(
    const std::vector<ScoreSummary>& summaries, const std::vector<std::string>& names,
    const std::vector<std::pair<std::string, std::int64_t (*)(const scoring::Score&)>>& counts) {
  std::vector<std::string> count_names;
  for (const auto& [name, of] : counts) count_names.push_back(name);
  Table table{header_with_intervals(view_columns, names, count_names), {}};
  for (const ScoreSummary& summary : summaries) {
    std::vector<Interval> intervals;
    for (const std::string& name : names) intervals.push_back(summary[name]);
    std::vector<std::string> totals;
    for (const auto& [name, of] : counts) totals.push_back(std::to_string(of(summary.total)));
    table.rows.push_back(row_with_intervals(setting(summary), intervals, totals));
  }
  return table;
}

}  // namespace

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

Table success_table(const std::vector<CellSummary>& summaries) {
  Table table{header_with_intervals(setting_columns, {"success"},
                                    {"always_contact_success", "knee_noise_nm", "wheel_noise_nm"}),
              {}};
  for (const CellSummary& s : summaries) {
    table.rows.push_back(
        row_with_intervals(setting(s.condition, s.cell), {s.success},
                           {metric(s.always_contact), exact(s.cell.knee), exact(s.cell.wheel)}));
  }
  return table;
}

Table classification_table(const std::vector<CellSummary>& summaries) {
  Table table{header_with_intervals(setting_columns,
                                    {"contact_precision", "contact_recall", "no_contact_precision",
                                     "no_contact_recall"},
                                    {"knee_noise_nm", "wheel_noise_nm"}),
              {}};
  for (const CellSummary& s : summaries) {
    table.rows.push_back(row_with_intervals(
        setting(s.condition, s.cell),
        {s.contact_precision, s.contact_recall, s.no_contact_precision, s.no_contact_recall},
        {exact(s.cell.knee), exact(s.cell.wheel)}));
  }
  return table;
}

Table views_table(const std::vector<ScoreSummary>& summaries) {
  return table_of(
      summaries,
      {"success", "contact_precision", "contact_recall", "no_contact_precision",
       "no_contact_recall"},
      {{"contact_steps", [](const scoring::Score& s) { return s.points.contact(); }},
       {"no_contact_steps", [](const scoring::Score& s) { return s.points.flight(); }}});
}

Table transitions_table(const std::vector<ScoreSummary>& summaries) {
  return table_of(
      summaries,
      {"takeoff_precision", "takeoff_recall", "landing_precision", "landing_recall",
       "false_takeoffs_per_minute"},
      {{"takeoffs", [](const scoring::Score& s) { return s.takeoff.events; }},
       {"false_takeoffs", [](const scoring::Score& s) { return s.takeoff.false_alarms; }},
       {"landings", [](const scoring::Score& s) { return s.landing.events; }},
       {"false_landings", [](const scoring::Score& s) { return s.landing.false_alarms; }}});
}

Table latency_table(const std::vector<ScoreSummary>& summaries) {
  return table_of(
      summaries,
      {"takeoff_latency_ms", "takeoff_latency_deviation_ms", "landing_latency_ms",
       "landing_latency_deviation_ms"},
      {{"takeoffs_detected", [](const scoring::Score& s) { return s.takeoff.detected; }},
       {"landings_detected", [](const scoring::Score& s) { return s.landing.detected; }}});
}

Table calibration_table(const std::vector<ScoreSummary>& summaries) {
  return table_of(summaries, {"brier"},
                  {{"steps", [](const scoring::Score& s) { return s.calibration.points; }}});
}

Table reliability_table(const std::vector<ScoreSummary>& summaries) {
  std::vector<std::string> first = view_columns;
  first.insert(first.end(), {"bin", "steps", "mean_probability"});
  Table table{header_with_intervals(first, {"contact_frequency"}), {}};
  for (const ScoreSummary& summary : summaries) {
    for (std::size_t b = 0; b < scoring::Calibration::bins; ++b) {
      const scoring::Calibration::Bin& bin = summary.total.calibration.bin[b];
      std::vector<std::string> row = setting(summary);
      row.insert(row.end(),
                 {std::to_string(b), std::to_string(bin.points), metric(bin.mean_probability())});
      table.rows.push_back(row_with_intervals(row, {summary.contact_frequency[b]}));
    }
  }
  return table;
}

Table differences_table(const std::vector<Difference>& differences) {
  Table table{header_with_intervals({"simulator", "torque_noise_nm", "accelerometer_noise_mps2",
                                     "first", "second", "metric"},
                                    {"difference"}),
              {}};
  for (const Difference& difference : differences) {
    for (std::size_t m = 0; m < scoring::metrics().size(); ++m) {
      table.rows.push_back(
          row_with_intervals({difference.simulator, exact(difference.cell.torque),
                              exact(difference.cell.accelerometer), difference.first,
                              difference.second, scoring::metrics()[m].name},
                             {difference.metric[m]}));
    }
  }
  return table;
}

}  // namespace touchdown::experiments
