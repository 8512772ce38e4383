#include "experiments/studies/sensor_sweep/tables.hpp"

#include <fmt/format.h>

#include "core/tables/table.hpp"
#include "experiments/results/captions.hpp"

namespace touchdown::experiments {

namespace {

const std::vector<std::string> shown_metrics = {
    "success",        "no_contact_precision",      "no_contact_recall",  "takeoff_recall",
    "landing_recall", "false_takeoffs_per_minute", "takeoff_latency_ms", "landing_latency_ms"};

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
  Table table{header_with_intervals({"simulator", "disturbance", "value", "estimator"},
                                    shown_metrics, {"takeoffs"}),
              {}};
  for (const SensorSweepPoint& point : points) {
    for (const ScoreSummary& summary : point.scores) {
      std::vector<Interval> intervals;
      for (const std::string& metric : shown_metrics) intervals.push_back(summary[metric]);
      table.rows.push_back(
          row_with_intervals({summary.condition.test_simulator, point.variation.key,
                              exact(point.variation.value), summary.condition.estimator},
                             intervals, {std::to_string(summary.total.takeoff.events)}));
    }
  }
  directory.write_table("sensor_sweep.csv", table);
}

std::string sensor_sweep_text(const std::vector<SensorSweepPoint>& points,
                              const Experiment& experiment) {
  std::string text = fmt::format(
      "Accuracy by sensor disturbance ({}{}; {}); estimators are fitted without the "
      "disturbance\n",
      noise_text(experiment.highlights.front()), setup_caption(experiment),
      intervals_text(experiment));
  for (const SensorFactor& factor : experiment.sweep) {
    for (const std::string& simulator : experiment.simulators) {
      Table table{{fmt::format("{}, {}", factor.key, simulator)}, {}};
      for (const SensorSweepPoint& point : points) {
        if (point.variation.key != factor.key) continue;
        table.header.push_back(exact(point.variation.value));
        std::size_t row = 0;
        for (const ScoreSummary& summary : point.scores) {
          if (summary.condition.test_simulator != simulator) continue;
          if (row == table.rows.size()) {
            table.rows.push_back({estimator_title(summary.condition.estimator)});
          }
          table.rows[row++].push_back(with_interval(summary["success"]));
        }
      }
      text += fmt::format("\n{}", to_text(table));
    }
  }
  return text;
}

}  // namespace touchdown::experiments
