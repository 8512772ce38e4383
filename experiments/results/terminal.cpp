#include "experiments/results/terminal.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "experiments/config/experiment_estimators.hpp"
#include "experiments/results/captions.hpp"
#include "experiments/results/paper.hpp"
#include "experiments/plan/rollouts.hpp"

namespace touchdown::experiments {

namespace {

/// Every estimator of one engine in one cell.
Table cell_table(const ExperimentResult& result, const std::string& simulator,
                 const noise::NoiseCell& cell) {
  Table table{{"estimator", "accuracy", "contact precision", "recall", "no contact precision",
               "recall", "false takeoffs/min"},
              {}};
  for (const CellSummary& summary : result.summaries) {
    if (summary.condition.test_simulator != simulator || !(summary.cell == cell)) continue;
    table.rows.push_back({estimator_entry(result.experiment, summary.condition.estimator).title});
    for (const PointMetric& metric : point_metrics) {
      Interval interval = summary.*metric.interval;
      if (metric.interval != &CellSummary::success) interval.low = NAN;
      table.rows.back().push_back(with_interval(interval));
    }
    table.rows.back().push_back(false_takeoffs_text(result.scores, summary));
  }
  return table;
}

/// One estimator's accuracy over the noise grid.
Table grid_table(const std::vector<CellSummary>& summaries, const std::string& simulator,
                 const std::string& estimator, const noise::NoiseGridConfig& noise) {
  Table table{{"torque noise"}, {}};
  for (const double level : noise.accelerometer) {
    table.header.push_back(fmt::format("{} m/s²", level));
  }
  for (const double torque : noise.torque) table.rows.push_back({fmt::format("{} N·m", torque)});
  for (const CellSummary& summary : summaries) {
    const Condition& condition = summary.condition;
    if (condition.test_simulator != simulator || condition.estimator != estimator) continue;
    const auto row = std::find(noise.torque.begin(), noise.torque.end(), summary.cell.torque);
    const bool on_grid = row != noise.torque.end() &&
                         std::find(noise.accelerometer.begin(), noise.accelerometer.end(),
                                   summary.cell.accelerometer) != noise.accelerometer.end();
    if (!on_grid) continue;
    table.rows[static_cast<std::size_t>(row - noise.torque.begin())].push_back(
        fmt::format("{:.3f}{}", summary.success.estimate, summary.loses() ? "*" : ""));
  }
  return table;
}

}  // namespace

std::string summary_text(const ExperimentResult& result) {
  const Experiment& experiment = result.experiment;
  std::string text;
  for (const std::string& simulator : experiment.simulators) {
    const TestRuns runs = test_runs(result, simulator);
    if (runs.scored == 0) {
      text += fmt::format("\n{}: no test run stayed upright: nothing is scored\n", simulator);
      continue;
    }
    for (const noise::NoiseCell& cell : experiment.highlights) {
      text += fmt::format("\n{}: {} × {}, {}{}\n\n", simulator, text_of(runs),
                          plural(static_cast<std::size_t>(experiment.noise.seeds), "noise seed"),
                          noise_text(cell), setup_caption(experiment));
      text += to_text(cell_table(result, simulator, cell));
    }
    if (result.cells.size() > 1) {
      const std::string& first = experiment.estimators.front();
      text += fmt::format(
          "\n{}: accuracy of {} by torque and accelerometer noise "
          "(* no better than always contact){}\n\n",
          simulator, estimator_entry(experiment, first).title, setup_caption(experiment));
      text += to_text(grid_table(result.summaries, simulator, first, experiment.noise));
    }
  }
  if (experiment.paper_tables) {
    for (const CaptionedTable& table : paper_tables(result)) text += '\n' + to_text(table);
  }
  for (const std::string& study : result.studies) text += '\n' + study;
  text += fmt::format("\n{}\n", conditions_text(experiment));
  return text + unused_runs_text(result.runs);
}

std::string closing_text(const ExperimentResult& result) {
  const noise::NoiseCell& cell = result.experiment.highlights.back();
  Table table{{"estimator"}, {}};
  for (const std::string& simulator : result.experiment.simulators) {
    table.header.insert(table.header.end(), {simulator, "false takeoffs/min"});
  }
  for (const CellSummary& summary : result.summaries) {
    if (!summary.condition.is_fitted_in_domain() || !(summary.cell == cell)) continue;
    const std::string& title =
        estimator_entry(result.experiment, summary.condition.estimator).title;
    auto row = std::find_if(table.rows.begin(), table.rows.end(),
                            [&](const auto& cells) { return cells.front() == title; });
    if (row == table.rows.end()) row = table.rows.insert(row, {title});
    row->push_back(with_interval(summary.success));
    row->push_back(false_takeoffs_text(result.scores, summary));
  }
  return fmt::format("\nContact accuracy, {}{}\n\n{}", noise_text(cell),
                     setup_caption(result.experiment), to_text(table));
}

}  // namespace touchdown::experiments
