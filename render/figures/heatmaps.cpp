#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "experiments/config/experiment.hpp"
#include "experiments/estimators/baselines.hpp"
#include "experiments/results/captions.hpp"
#include "render/figures/figures.hpp"
#include "render/stop.hpp"
#include "simulators/registry.hpp"

namespace touchdown::render {

namespace {

/// The coordinates of a noise cell on a map.
using CellCoordinates = std::function<std::array<double, 2>(const noise::NoiseCell&)>;

std::size_t index_in(const std::vector<double>& levels, double level) {
  return static_cast<std::size_t>(std::find(levels.begin(), levels.end(), level) - levels.begin());
}

HeatmapPanel panel_of(const experiments::ExperimentResult& result, const std::string& simulator,
                      const std::string& estimator, const Heatmap& heatmap,
                      const CellCoordinates& coordinates) {
  HeatmapPanel panel;
  panel.title = experiments::estimator_entry(result.experiment, estimator).title;
  for (auto* rows : {&panel.value, &panel.low, &panel.high}) {
    rows->assign(heatmap.y.size(), std::vector<double>(heatmap.x.size(), NAN));
  }
  panel.marked.assign(heatmap.y.size(), std::vector<bool>(heatmap.x.size(), false));
  for (const experiments::CellSummary& summary : result.summaries) {
    const experiments::Condition& condition = summary.condition;
    if (condition.test_simulator != simulator || condition.estimator != estimator) continue;
    const auto [x, y] = coordinates(summary.cell);
    const std::size_t column = index_in(heatmap.x, x), row = index_in(heatmap.y, y);
    if (column == heatmap.x.size() || row == heatmap.y.size()) continue;
    panel.value[row][column] = error_percent(summary.success.estimate);
    panel.low[row][column] = error_percent(summary.success.high);
    panel.high[row][column] = error_percent(summary.success.low);
    panel.marked[row][column] = summary.loses();
  }
  return panel;
}

/// The width of the widest interval of all panels, for maps with too many cells to show them.
double widest_interval(const Heatmap& heatmap) {
  double widest = 0.0;
  for (const HeatmapPanel& panel : heatmap.panels) {
    for (std::size_t row = 0; row < panel.value.size(); ++row) {
      for (std::size_t column = 0; column < panel.value[row].size(); ++column) {
        widest = std::fmax(widest, panel.high[row][column] - panel.low[row][column]);
      }
    }
  }
  return widest;
}

double always_contact(const experiments::ExperimentResult& result, const std::string& simulator) {
  for (const experiments::CellSummary& summary : result.summaries) {
    if (summary.condition.test_simulator == simulator) return summary.always_contact;
  }
  return NAN;
}

/// The map of these axes with its panels, caption and lines.
Heatmap filled(Heatmap heatmap, const experiments::ExperimentResult& result,
               const std::string& simulator, const CellCoordinates& coordinates) {
  const experiments::Experiment& experiment = result.experiment;
  for (const std::string& estimator : mapped_estimators(experiment)) {
    heatmap.panels.push_back(panel_of(result, simulator, estimator, heatmap, coordinates));
  }
  heatmap.caption = fmt::format(
      "Error rate: the share of steps with a wrong decision; {}. Always contact has an error rate "
      "of {} %; crossed cells do not beat it. Lines run between cells below and above {} %. The "
      "colour scale ends at {} and {} % and is the same in every map.",
      experiments::scored_text(result, simulator),
      error_text(error_percent(always_contact(result, simulator))), fmt::join(heatmap.levels, ", "),
      lowest_error, highest_error);
  if (heatmap.x.size() * heatmap.y.size() > most_numbered_cells) {
    heatmap.caption +=
        fmt::format(" The widest {:.0f} % interval over {}s spans {:.1f} percentage points.",
                    100.0 * experiment.intervals.bootstrap.level,
                    experiments::sample_text(experiment), widest_interval(heatmap));
    for (HeatmapPanel& panel : heatmap.panels) panel.low = panel.high = {};
  }
  return heatmap;
}

}  // namespace

std::vector<std::string> mapped_estimators(const experiments::Experiment& experiment) {
  std::vector<std::string> names = experiment.estimators;
  std::erase(names, experiments::always_contact_name);
  return names;
}

void draw_heatmaps(const experiments::ExperimentResult& result, const std::atomic<bool>* stop) {
  const experiments::Experiment& experiment = result.experiment;
  const noise::KneeWheelGridConfig& apart = experiment.noise.knee_wheel;
  const CellCoordinates by_torque = [](const noise::NoiseCell& cell) {
    return std::array{cell.accelerometer, cell.torque};
  };
  const CellCoordinates by_joint = [&](const noise::NoiseCell& cell) {
    return cell.accelerometer == apart.accelerometer ? std::array{cell.wheel, cell.knee}
                                                     : std::array<double, 2>{NAN, NAN};
  };
  for (const std::string& simulator : experiment.simulators) {
    stop_if_asked(stop);
    if (experiments::test_runs(result, simulator).scored == 0) continue;
    const std::string where =
        fmt::format("{}, {}", experiment.name, simulators::simulator_title(simulator));
    Heatmap heatmap;
    heatmap.title = "Error rate under sensor noise: " + where;
    heatmap.x_label = "accelerometer noise (m/s²)";
    heatmap.y_label = "torque noise (N·m)";
    heatmap.x = experiment.noise.accelerometer;
    heatmap.y = experiment.noise.torque;
    draw_heatmap(filled(heatmap, result, simulator, by_torque),
                 result.directory.file("figures", "error_" + simulator));
    if (apart.knee.empty()) continue;
    stop_if_asked(stop);
    heatmap.title = fmt::format("Error rate under torque noise, {} m/s² on the accelerometer: {}",
                                apart.accelerometer, where);
    heatmap.x_label = "wheel torque noise (N·m)";
    heatmap.y_label = "knee torque noise (N·m)";
    heatmap.x = apart.wheel;
    heatmap.y = apart.knee;
    draw_heatmap(filled(heatmap, result, simulator, by_joint),
                 result.directory.file("figures", "knee_wheel_" + simulator));
  }
}

}  // namespace touchdown::render
