#include "cli/heatmaps.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "experiments/estimator_registry.hpp"

namespace touchdown {

namespace {

HeatmapPanel panel_of(const ExperimentResult& result, const std::string& simulator,
                      const std::string& estimator) {
  const NoiseGridConfig& noise = result.experiment.noise;
  HeatmapPanel panel;
  panel.title = estimator_entry(estimator).title;
  for (auto* rows : {&panel.value, &panel.low, &panel.high}) {
    rows->assign(noise.torque.size(), std::vector<double>(noise.accelerometer.size(), NAN));
  }
  for (const CellSummary& summary : result.summaries) {
    const Condition& who = summary.condition;
    if (who.test_simulator != simulator || who.estimator != estimator) continue;
    const auto place = [](const std::vector<double>& levels, double level) {
      return static_cast<std::size_t>(std::find(levels.begin(), levels.end(), level) -
                                      levels.begin());
    };
    const std::size_t row = place(noise.torque, summary.cell.torque);
    const std::size_t column = place(noise.accelerometer, summary.cell.accelerometer);
    panel.value[row][column] = summary.success.estimate;
    panel.low[row][column] = summary.success.low;
    panel.high[row][column] = summary.success.high;
  }
  return panel;
}

double always_contact(const ExperimentResult& result, const std::string& simulator) {
  for (const CellSummary& summary : result.summaries) {
    if (summary.condition.test_simulator == simulator) return summary.always_contact;
  }
  return NAN;
}

}  // namespace

Heatmap success_heatmap(const ExperimentResult& result, const std::string& simulator) {
  const Experiment& experiment = result.experiment;
  Heatmap heatmap;
  heatmap.title =
      fmt::format("Success rate under sensor noise: {}, {}", experiment.name, simulator);
  heatmap.x_label = "accelerometer noise (m/s²)";
  heatmap.y_label = "torque noise (N·m)";
  heatmap.value_label = "success rate";
  heatmap.x = experiment.noise.accelerometer;
  heatmap.y = experiment.noise.torque;
  for (const std::string& estimator : experiment.estimators) {
    heatmap.panels.push_back(panel_of(result, simulator, estimator));
  }
  const auto runs = scored_runs(result.runs);
  const auto scored = std::count_if(runs.begin(), runs.end(), [&](const HeardRun* run) {
    return run->info.simulator == simulator;
  });
  heatmap.caption = fmt::format(
      "{} test runs × {} noise seeds; contact: normal force > {} N, states under {} ms merged; "
      "always contact scores {:.3f}",
      scored, experiment.noise.seeds, experiment.labels.force_threshold,
      1e3 * experiment.labels.debounce, always_contact(result, simulator));
  heatmap.iso_levels = {0.9, 0.95, 0.98};
  return heatmap;
}

}  // namespace touchdown
