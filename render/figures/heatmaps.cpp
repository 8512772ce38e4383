#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include "core/interval.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/estimators/baselines.hpp"
#include "experiments/results/captions.hpp"
#include "render/figures/chosen_run.hpp"
#include "render/figures/figures.hpp"
#include "render/gnuplot/facets.hpp"
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

/// The caption of a map with these cells.
std::string caption_of(const experiments::ExperimentResult& result, const std::string& simulator,
                       const Table& cells) {
  const experiments::PointMetric& metric = experiments::mapped_metric(result.experiment);
  double widest = 0.0;  // not all maps show their intervals
  for (const TableRow& cell : cells.all()) {
    const Interval interval = cell.interval(metric.name);
    widest = std::fmax(widest, interval.high - interval.low);
  }
  const std::string always =
      is_success(metric) && !cells.rows.empty()
          ? fmt::format("Always contact has {:.2f} %; crossed cells do not beat it. ",
                        100.0 * cells.all().front().number("always_contact_success"))
          : "";
  return fmt::format(
      "{}{}; {}. {}The colour scale ends at {} and {} % and is the same in every map. The widest "
      "{:.0f} % interval over {}s spans {:.1f} percentage points.",
      capitalised(metric.title),
      is_success(metric) ? ": the share of steps with a correct decision" : "",
      experiments::scored_text(result, simulator), always, lowest_shade, highest_shade,
      100.0 * result.experiment.intervals.bootstrap.level,
      experiments::sample_text(result.experiment), 100.0 * widest);
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

Table mapped_cells(const Table& cells, const NoiseMaps& maps, const std::string& simulator) {
  const auto is_on = [](const NoiseAxis& axis, const TableRow& cell) {
    return std::ranges::find(axis.levels, cell.number(axis.column)) != axis.levels.end();
  };
  Table table{cells.columns, {}};
  table.columns.push_back({"loses"});
  for (std::size_t i = 0; i < cells.rows.size(); ++i) {
    const TableRow cell(cells, i);
    const bool is_mapped =
        cell.text("simulator") == simulator &&
        cell.text("estimator") != experiments::always_contact_name && is_on(maps.x, cell) &&
        is_on(maps.y, cell) &&
        (!maps.accelerometer || cell.number("accelerometer_noise_mps2") == *maps.accelerometer);
    if (!is_mapped) continue;
    table.rows.push_back(cells.rows[i]);
    table.rows.back().emplace_back(experiments::loses(cell) ? "yes" : "no");
  }
  return table;
}

experiments::FigureSpec map_figure(const Table& cells, const NoiseMaps& maps,
                                   const experiments::Experiment& experiment,
                                   const std::string& simulator) {
  const experiments::PointMetric& metric = experiments::mapped_metric(experiment);
  const auto axis = [](const NoiseAxis& noise) {
    return experiments::FigureAxis{.column = noise.column,
                                   .title = noise.title,
                                   .unit = noise.unit,
                                   .scale = experiments::AxisScale::ordinal};
  };
  experiments::FigureSpec spec;
  spec.name = fmt::format("{}_{}", maps.name, simulator);
  spec.panels.columns = {"estimator"};
  for (const std::string& name : mapped_estimators(experiment)) {
    spec.panels.groups.push_back({{name}, experiments::estimator_title_in(experiment, name)});
  }
  spec.x = axis(maps.x);
  spec.y = axis(maps.y);
  spec.measures = {experiments::axis_with_interval(metric.name, metric.title)};
  spec.measures.front().unit = "%";
  spec.measures.front().factor = 100.0;
  spec.marks = {{experiments::MarkShape::image}};
  if (is_success(metric)) {
    spec.marks.push_back({experiments::MarkShape::cross, {{"loses", "yes"}}});
  }
  spec.marks.push_back({experiments::MarkShape::number});
  spec.title = fmt::format("{}: {}, {}", maps.title, experiment.name,
                           simulators::simulator_title(simulator));
  const auto at = [&](double x, double y) {
    experiments::FigureSpec corner = spec;
    corner.where.push_back({maps.x.column, exact(x)});
    corner.where.push_back({maps.y.column, exact(y)});
    return experiments::values_text(corner, cells);
  };
  spec.alt = fmt::format(
      "Maps of the {} by {} (across) and {} (up). In the lower left cells:{} In the "
      "upper right ones:{}",
      metric.title, maps.x.title, maps.y.title, at(maps.x.levels.front(), maps.y.levels.front()),
      at(maps.x.levels.back(), maps.y.levels.back()));
  return spec;
}

void draw_heatmaps(const experiments::ExperimentResult& result, const std::atomic<bool>* stop) {
  for (const std::string& simulator : result.experiment.simulators) {
    if (experiments::test_runs(result, simulator).scored == 0) continue;
    for (const NoiseMaps& maps : noise_maps(result.experiment)) {
      stop_if_asked(stop);
      const Table cells = mapped_cells(result.tables.cells, maps, simulator);
      experiments::FigureSpec spec = map_figure(cells, maps, result.experiment, simulator);
      spec.caption = caption_of(result, simulator, cells);
      draw_facets(spec, cells, figure_file(result, spec.name));
    }
  }
}

}  // namespace touchdown::render
