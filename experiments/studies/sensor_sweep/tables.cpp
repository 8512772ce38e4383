#include "experiments/studies/sensor_sweep/tables.hpp"

#include <array>
#include <utility>

#include <fmt/format.h>

#include "core/rows.hpp"
#include "experiments/results/captions.hpp"

namespace touchdown::experiments {

namespace {

constexpr std::array shown_metrics = {
    "success",        "no_contact_precision",      "no_contact_recall",  "takeoff_recall",
    "landing_recall", "false_takeoffs_per_minute", "takeoff_latency_ms", "landing_latency_ms"};

/// One estimator at one value.
struct SweepRow {
  SensorVariation variation;
  ScoreSummary score;

  const std::string& simulator() const { return score.condition.test_simulator; }
  const std::string& estimator() const { return score.condition.estimator; }
};

std::vector<SweepRow> rows_of(const std::vector<SensorSweepPoint>& points) {
  std::vector<SweepRow> rows;
  for (const SensorSweepPoint& point : points) {
    for (const ScoreSummary& score : point.scores) rows.push_back({point.variation, score});
  }
  return rows;
}

Columns<SweepRow> sweep_columns() {
  Columns<SweepRow> columns;
  columns.text("simulator", &SweepRow::simulator)
      .text("disturbance", [](const SweepRow& row) { return row.variation.key; })
      .level("value", [](const SweepRow& row) { return row.variation.value; })
      .text("estimator", &SweepRow::estimator);
  for (const char* const name : shown_metrics) {
    columns.interval(name, [name](const SweepRow& row) { return row.score[name]; });
  }
  return columns.count("takeoffs",
                       [](const SweepRow& row) { return row.score.total.takeoff.events; });
}

}  // namespace

std::vector<SensorSweepPoint> sensor_sweep(const Evaluation& evaluation) {
  const Experiment& experiment = evaluation.request.experiment;
  std::vector<SensorSweepPoint> points;
  for (const SensorVariation& variation : sensor_variations(experiment)) {
    const auto runs = evaluation.plan.runs_in(group_of(variation, evaluation.plan));
    const CollectedCounts counts = collect(evaluation.plan, runs, evaluation.saved);
    SensorSweepPoint point{variation, {}};
    for (ScoreSummary& summary : summarise(counts.scored, {&experiment.highlights.front(), 1},
                                           experiment.intervals.bootstrap)) {
      if (summary.view == scoring::scored_views().front()) {
        point.scores.push_back(std::move(summary));
      }
    }
    points.push_back(std::move(point));
  }
  return points;
}

void write_tables(const std::vector<SensorSweepPoint>& points, const RunDirectory& directory) {
  directory.write_table("sensor_sweep.csv", sweep_columns(), rows_of(points));
}

std::string sensor_sweep_text(const std::vector<SensorSweepPoint>& points,
                              const Experiment& experiment) {
  std::string text = fmt::format(
      "Accuracy by sensor disturbance ({}{}; {}); estimators are fitted without the "
      "disturbance\n",
      noise_text(experiment.highlights.front()), setup_caption(experiment),
      intervals_text(experiment));
  const auto engine_and_disturbance = [](const SweepRow& row) {
    return std::pair(row.variation.key, row.simulator());
  };
  for (const auto& [key, alike] : group_by(rows_of(points), engine_and_disturbance)) {
    Table table = pivot(
        alike, [&](const SweepRow& row) { return estimator_title_in(experiment, row.estimator()); },
        [](const SweepRow& row) { return exact(row.variation.value); },
        [](const SweepRow& row) { return with_interval(row.score["success"]); });
    table.header.front() = fmt::format("{}, {}", key.first, key.second);
    text += fmt::format("\n{}", to_text(table));
  }
  return text;
}

}  // namespace touchdown::experiments
