#include "experiments/studies/closed_loop/tables.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/tables/table.hpp"
#include "experiments/odometry/contact_sources.hpp"
#include "experiments/results/captions.hpp"
#include "scoring/exact_share.hpp"
#include "simulators/registry.hpp"

namespace touchdown::experiments {

namespace {

std::string stem(const std::string& file, const char* none) {
  return file.empty() ? none : std::filesystem::path(file).stem().string();
}

std::vector<ClosedLoopMetrics> saved_metrics(const SavedClosedLoops& saved, std::size_t cell,
                                             std::size_t runs) {
  std::vector<ClosedLoopMetrics> metrics;
  for (std::size_t run = cell * runs; run < (cell + 1) * runs; ++run) {
    const std::optional<ClosedLoopMetrics> of_run = saved.read(run);
    if (!of_run) throw Error(fmt::format("run {} of the closed loop is missing", run));
    metrics.push_back(*of_run);
  }
  return metrics;
}

/// The identity of a cell, without its contact source.
auto without_source(const ClosedLoopCell& cell) {
  return std::tie(cell.simulator, cell.law, cell.scene, cell.point);
}

/// A point of its curve, for display: "rise 0.7", "20 ms", "1 N·m, 5 m/s²".
std::string point_text(const SurvivalRow& row) {
  if (row.varied == "delay") return fmt::format("{:g} ms", 1e3 * row.cell.delay);
  if (row.varied == "noise") {
    return fmt::format("{:g} N·m, {:g} m/s²", row.cell.noise.torque, row.cell.noise.accelerometer);
  }
  return row.varied.empty() ? "finished" : fmt::format("{} {:g}", row.varied, row.cell.value);
}

/// The points of a curve, then the other metrics at the last point.
std::vector<std::string> curve_cells(std::vector<SurvivalRow>::const_iterator first,
                                     std::vector<SurvivalRow>::const_iterator last) {
  std::vector<std::string> cells = {contact_title(first->cell.contact)};
  for (auto row = first; row != last; ++row) {
    cells.push_back(fmt::format("{}/{}", row->metrics.finished, row->metrics.runs));
  }
  const ClosedLoopMetrics& end = (last - 1)->metrics;
  cells.push_back(fmt::format("{:.2f}", end.landing_speed_rms()));
  cells.push_back(fmt::format("{:.2f}", end.mean_largest_pitch()));
  cells.push_back(fmt::format("{:.0f}", end.mean_largest_force()));
  cells.push_back(fmt::format("{:.1f}", end.false_takeoffs_per_minute()));
  return cells;
}

}  // namespace

std::vector<SurvivalRow> survival_rows(const RunRequest& request, const SavedClosedLoops& saved) {
  const Experiment& experiment = request.experiment;
  const ClosedLoopConfig& config = *experiment.closed_loop;
  const auto runs = static_cast<std::size_t>(config.runs);
  const std::vector<ClosedLoopCell> cells = closed_loop_cells(experiment);
  std::vector<std::vector<ClosedLoopMetrics>> by_cell;
  for (std::size_t i = 0; i < cells.size(); ++i) by_cell.push_back(saved_metrics(saved, i, runs));
  std::vector<SurvivalRow> rows;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const ClosedLoopScene& scene = config.scenes[cells[i].scene];
    const scenarios::Scenario& scenario = scenario_of(request, scene.scenario).scenario;
    SurvivalRow row{.cell = cells[i],
                    .scene = scenario.name,
                    .robot = scenario.robot.stem().string(),
                    .sensors = stem(experiment.sensors, "ideal"),
                    .varied = varied_quantity(scene),
                    .key = scene.key};
    for (const ClosedLoopMetrics& of_run : by_cell[i]) row.metrics += of_run;
    row.finished = scoring::exact_share(row.metrics.finished, row.metrics.runs,
                                        experiment.intervals.bootstrap.level);
    const auto always = std::find_if(cells.begin(), cells.end(), [&](const ClosedLoopCell& other) {
      return other.contact == "always" && without_source(other) == without_source(cells[i]);
    });
    if (always != cells.end()) {
      const auto& others = by_cell[static_cast<std::size_t>(always - cells.begin())];
      for (std::size_t run = 0; run < runs; ++run) {
        row.won_against_always += by_cell[i][run].finished > others[run].finished ? 1 : 0;
        row.lost_against_always += by_cell[i][run].finished < others[run].finished ? 1 : 0;
      }
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

void write_tables(const std::vector<SurvivalRow>& rows, const RunDirectory& directory) {
  Table table{{"simulator",
               "scenario",
               "policy",
               "contact",
               "rise_m",
               "runs",
               "finished",
               "finished_low",
               "finished_high",
               "varied",
               "key",
               "value",
               "delay_ms",
               "torque_noise_nm",
               "accelerometer_noise_mps2",
               "robot",
               "sensors",
               "is_oracle",
               "fell",
               "won_against_always",
               "lost_against_always",
               "landings",
               "landing_speed_rms_mps",
               "largest_pitch_rad",
               "largest_force_n",
               "false_takeoffs_per_minute"},
              {}};
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (const SurvivalRow& row : rows) {
    const ClosedLoopCell& cell = row.cell;
    const ClosedLoopMetrics& metrics = row.metrics;
    const bool is_rise = row.key == "rise" || row.key.ends_with(".rise");
    table.rows.push_back({cell.simulator,
                          row.scene,
                          cell.law,
                          cell.contact,
                          exact(is_rise ? cell.value : nan),
                          std::to_string(metrics.runs),
                          metric(row.finished.estimate),
                          metric(row.finished.low),
                          metric(row.finished.high),
                          row.varied,
                          row.key,
                          exact(cell.value),
                          exact(1e3 * cell.delay),
                          exact(cell.noise.torque),
                          exact(cell.noise.accelerometer),
                          row.robot,
                          row.sensors,
                          cell.is_oracle() ? "1" : "0",
                          std::to_string(metrics.fell),
                          std::to_string(row.won_against_always),
                          std::to_string(row.lost_against_always),
                          std::to_string(metrics.landings),
                          metric(metrics.landing_speed_rms()),
                          metric(metrics.mean_largest_pitch()),
                          metric(metrics.mean_largest_force()),
                          metric(metrics.false_takeoffs_per_minute())});
  }
  directory.write_table("survival.csv", table);
}

std::string survival_text(const std::vector<SurvivalRow>& rows, const Experiment& experiment) {
  std::string text = fmt::format(
      "Finished runs of {}, by contact source of the policy{}; equal starts for all sources. At "
      "the last point: RMS slip speed of the tyres at landings, means over runs of the largest "
      "pitch and normal force, false takeoffs per minute of contact:\n",
      experiment.closed_loop->runs, setup_caption(experiment));
  Table table;
  for (auto first = rows.begin(); first != rows.end();) {
    const auto last = std::find_if(first, rows.end(), [&](const SurvivalRow& row) {
      return row.cell.contact != first->cell.contact || row.cell.scene != first->cell.scene ||
             row.cell.simulator != first->cell.simulator || row.cell.law != first->cell.law;
    });
    if (table.rows.empty()) {
      table.header = {fmt::format("{}, {}, {}", first->scene, first->cell.law,
                                  simulators::simulator_title(first->cell.simulator))};
      for (auto row = first; row != last; ++row) table.header.push_back(point_text(*row));
      table.header.insert(table.header.end(),
                          {"slip (m/s)", "pitch (rad)", "force (N)", "false takeoffs/min"});
    }
    table.rows.push_back(curve_cells(first, last));
    const bool is_last = last == rows.end() || last->cell.scene != first->cell.scene ||
                         last->cell.simulator != first->cell.simulator ||
                         last->cell.law != first->cell.law;
    if (is_last) {
      text += fmt::format("\n{}", to_text(table));
      table = {};
    }
    first = last;
  }
  return text;
}

}  // namespace touchdown::experiments
