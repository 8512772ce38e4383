#include "experiments/results/scores.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "experiments/estimators/registry.hpp"

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

Columns<CellSummary> success_columns() {
  return setting_columns<CellSummary>()
      .interval("success", &CellSummary::success)
      .metric("always_contact_success", &CellSummary::always_contact)
      .part(&CellSummary::cell, knee_wheel_columns());
}

Columns<CellSummary> classification_columns() {
  Columns<CellSummary> columns = setting_columns<CellSummary>();
  for (const PointMetric& metric : point_metrics) {
    if (metric.interval != &CellSummary::success) columns.interval(metric.name, metric.interval);
  }
  return columns.part(&CellSummary::cell, knee_wheel_columns());
}

Columns<ScoreSummary> views_columns() {
  return columns_of(
      {"success", "contact_precision", "contact_recall", "no_contact_precision",
       "no_contact_recall"},
      {{"contact_steps", [](const scoring::Score& s) { return s.points.contact(); }},
       {"no_contact_steps", [](const scoring::Score& s) { return s.points.flight(); }}});
}

Columns<ScoreSummary> transitions_columns() {
  return columns_of(
      {"takeoff_precision", "takeoff_recall", "landing_precision", "landing_recall",
       "false_takeoffs_per_minute"},
      {{"takeoffs", [](const scoring::Score& s) { return s.takeoff.events; }},
       {"false_takeoffs", [](const scoring::Score& s) { return s.takeoff.false_alarms; }},
       {"landings", [](const scoring::Score& s) { return s.landing.events; }},
       {"false_landings", [](const scoring::Score& s) { return s.landing.false_alarms; }}});
}

Columns<ScoreSummary> latency_columns() {
  return columns_of(
      {"takeoff_latency_ms", "takeoff_latency_deviation_ms", "landing_latency_ms",
       "landing_latency_deviation_ms"},
      {{"takeoffs_detected", [](const scoring::Score& s) { return s.takeoff.detected; }},
       {"landings_detected", [](const scoring::Score& s) { return s.landing.detected; }}});
}

Columns<ScoreSummary> calibration_columns() {
  return columns_of({"brier"},
                    {{"steps", [](const scoring::Score& s) { return s.calibration.points; }}});
}

std::vector<ReliabilityBin> reliability_bins(const std::vector<ScoreSummary>& summaries) {
  std::vector<ReliabilityBin> bins;
  for (const ScoreSummary& summary : summaries) {
    for (std::size_t b = 0; b < scoring::Calibration::bins; ++b) bins.push_back({&summary, b});
  }
  return bins;
}

Columns<ReliabilityBin> reliability_columns() {
  using Bin = ReliabilityBin;
  const auto counts = [](const Bin& bin) -> const scoring::Calibration::Bin& {
    return bin.summary->total.calibration.bin[bin.index];
  };
  return Columns<Bin>()
      .part([](const Bin& bin) -> const ScoreSummary& { return *bin.summary; }, columns_of({}, {}))
      .number("bin", &Bin::index)
      .count("steps", [counts](const Bin& bin) { return counts(bin).points; })
      .metric("mean_probability",
              [counts](const Bin& bin) { return counts(bin).mean_probability(); })
      .interval("contact_frequency",
                [](const Bin& bin) { return bin.summary->contact_frequency[bin.index]; });
}

std::vector<MetricDifference> metric_differences(const std::vector<Difference>& differences) {
  std::vector<MetricDifference> all;
  for (const Difference& difference : differences) {
    for (std::size_t m = 0; m < scoring::metrics().size(); ++m) all.push_back({&difference, m});
  }
  return all;
}

Columns<MetricDifference> difference_columns() {
  using Row = MetricDifference;
  return Columns<Row>()
      .text("simulator", [](const Row& row) { return row.pair->simulator; })
      .part([](const Row& row) { return row.pair->cell; }, noise_columns())
      .text("first", [](const Row& row) { return row.pair->first; })
      .text("second", [](const Row& row) { return row.pair->second; })
      .text("metric", [](const Row& row) { return scoring::metrics()[row.metric].name; })
      .interval("difference", [](const Row& row) { return row.pair->metric[row.metric]; });
}

}  // namespace touchdown::experiments
