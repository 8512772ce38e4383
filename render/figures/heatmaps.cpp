#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include "core/interval.hpp"
#include "core/rows.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/estimators/baselines.hpp"
#include "experiments/results/captions.hpp"
#include "render/figures/chosen_run.hpp"
#include "render/figures/figures.hpp"
#include "render/palette.hpp"
#include "simulators/registry.hpp"

namespace touchdown::render {

namespace {

/// Only this metric is compared with that of always contact.
bool is_success(const experiments::PointMetric& metric) {
  return metric.of == &scoring::Classification::success;
}

std::string capitalised(std::string text) {
  text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  return text;
}

HeatmapPanel panel_of(const experiments::ExperimentResult& result, const std::string& simulator,
                      const std::string& estimator, const NoiseMaps& maps) {
  const experiments::PointMetric& metric = experiments::mapped_metric(result.experiment);
  const std::vector<TableRow> cells = mapped_cells(result.tables, simulator, estimator);
  HeatmapPanel panel;
  panel.title = experiments::estimator_entry(result.experiment, estimator).title;
  for (const double y : maps.y.levels) {
    for (auto* rows : {&panel.value, &panel.low, &panel.high}) rows->emplace_back();
    panel.marked.emplace_back();
    for (const double x : maps.x.levels) {
      const TableRow* const cell = maps.cell(cells, x, y);
      const Interval value =
          cell == nullptr ? Interval{NAN, NAN, NAN} : cell->interval(metric.name);
      panel.value.back().push_back(error_percent(value.estimate));
      panel.low.back().push_back(error_percent(value.high));
      panel.high.back().push_back(error_percent(value.low));
      panel.marked.back().push_back(cell != nullptr && is_success(metric) &&
                                    experiments::loses(*cell));
    }
  }
  return panel;
}

/// The width of the widest interval of all panels: not all maps show them.
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
  for (const TableRow& cell : result.tables.cells.all()) {
    if (cell.text("simulator") == simulator) return cell.number("always_contact_success");
  }
  return NAN;
}

Heatmap heatmap_of(const experiments::ExperimentResult& result, const std::string& simulator,
                   const NoiseMaps& maps) {
  const experiments::Experiment& experiment = result.experiment;
  Heatmap heatmap{.title = fmt::format("{}: {}, {}", maps.title, experiment.name,
                                       simulators::simulator_title(simulator)),
                  .x_label = fmt::format("{} ({})", maps.x.title, maps.x.unit),
                  .y_label = fmt::format("{} ({})", maps.y.title, maps.y.unit),
                  .x = maps.x.levels,
                  .y = maps.y.levels,
                  .panels = {},
                  .caption = {},
                  .value_label = experiments::mapped_metric(experiment).title};
  for (const std::string& estimator : mapped_estimators(experiment)) {
    heatmap.panels.push_back(panel_of(result, simulator, estimator, maps));
  }
  const experiments::PointMetric& metric = experiments::mapped_metric(experiment);
  const std::string always =
      is_success(metric)
          ? fmt::format("Always contact has {} %; crossed cells do not beat it. ",
                        success_text(error_percent(always_contact(result, simulator))))
          : "";
  heatmap.caption = fmt::format(
      "{}{}; {}. {}The colour scale ends at {} and {} % and is the same in every map. The widest "
      "{:.0f} % interval over {}s spans {:.1f} percentage points.",
      capitalised(metric.title),
      is_success(metric) ? ": the share of steps with a correct decision" : "",
      experiments::scored_text(result, simulator), always, success_of(highest_error),
      success_of(lowest_error), 100.0 * experiment.intervals.bootstrap.level,
      experiments::sample_text(experiment), widest_interval(heatmap));
  return heatmap;
}

}  // namespace

std::vector<std::string> mapped_estimators(const experiments::Experiment& experiment) {
  std::vector<std::string> names = experiment.estimators;
  std::erase(names, experiments::always_contact_name);
  return names;
}

std::vector<NoiseMaps> noise_maps(const experiments::Experiment& experiment) {
  const noise::NoiseGridConfig& noise = experiment.noise;
  const noise::KneeWheelGridConfig& joints = noise.knee_wheel;
  const std::string metric = capitalised(experiments::mapped_metric(experiment).title);
  std::vector<NoiseMaps> maps = {
      {"error",
       metric + " under sensor noise",
       {"accelerometer_noise_mps2", "m/s²", "accelerometer noise", "accelerometer noise",
        noise.accelerometer},
       {"torque_noise_nm", "N·m", "torque noise", "torque noise", noise.torque}}};
  if (joints.knee.empty()) return maps;
  maps.push_back({"knee_wheel",
                  fmt::format("{} under torque noise, {} m/s² on the accelerometer", metric,
                              joints.accelerometer),
                  {"wheel_noise_nm", "N·m", "wheel noise", "wheel torque noise", joints.wheel},
                  {"knee_noise_nm", "N·m", "knee noise", "knee torque noise", joints.knee},
                  joints.accelerometer});
  return maps;
}

std::vector<TableRow> mapped_cells(const experiments::ScoreTables& tables,
                                   const std::string& simulator, const std::string& estimator) {
  return where(tables.cells.all(), [&](const TableRow& cell) {
    return cell.text("simulator") == simulator && cell.text("estimator") == estimator;
  });
}

const TableRow* NoiseMaps::cell(const std::vector<TableRow>& cells, double at_x,
                                double at_y) const {
  const auto found = std::ranges::find_if(cells, [&](const TableRow& one) {
    return one.number(x.column) == at_x && one.number(y.column) == at_y &&
           (!accelerometer || one.number("accelerometer_noise_mps2") == *accelerometer);
  });
  return found == cells.end() ? nullptr : &*found;
}

void draw_heatmaps(const experiments::ExperimentResult& result, const std::atomic<bool>* stop) {
  for (const std::string& simulator : result.experiment.simulators) {
    if (experiments::test_runs(result, simulator).scored == 0) continue;
    for (const NoiseMaps& maps : noise_maps(result.experiment)) {
      stop_if_asked(stop);
      draw_heatmap(heatmap_of(result, simulator, maps),
                   figure_file(result, fmt::format("{}_{}", maps.name, simulator)));
    }
  }
}

double error_percent(double success) { return std::round(1e8 * (1.0 - success)) / 1e6; }

std::string success_text(double error) {
  if (!std::isfinite(error)) return "–";
  return fmt::format("{:.2f}", success_of(error));
}

bool is_light(double error) {
  const double clamped = std::clamp(error, lowest_error, highest_error);
  const double share = std::log(highest_error / clamped) / std::log(highest_error / lowest_error);
  const double at = share * (viridis.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(at), viridis.size() - 2);
  const auto part = [&](unsigned shift) {
    const double from = viridis[below] >> shift & 255U, to = viridis[below + 1] >> shift & 255U;
    const double value = from + (at - static_cast<double>(below)) * (to - from);
    return std::pow((value / 255.0 + 0.055) / 1.055, 2.4);
  };
  // At this luminance, white and black text have the same contrast.
  return 0.2126 * part(16) + 0.7152 * part(8) + 0.0722 * part(0) > 0.179;
}

}  // namespace touchdown::render
