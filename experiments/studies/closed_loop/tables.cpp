#include "experiments/studies/closed_loop/tables.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/rows.hpp"
#include "experiments/results/captions.hpp"
#include "experiments/results/odometry.hpp"
#include "experiments/results/scores.hpp"
#include "scoring/exact_share.hpp"
#include "simulators/registry.hpp"

namespace touchdown::experiments {

namespace {

std::string stem(const std::string& file, const char* none) {
  return file.empty() ? none : std::filesystem::path(file).stem().string();
}

using SavedMetrics = std::function<std::optional<ClosedLoopMetrics>(std::size_t run)>;

std::vector<ClosedLoopMetrics> saved_metrics(const SavedMetrics& saved, std::size_t cell,
                                             std::size_t runs) {
  std::vector<ClosedLoopMetrics> metrics;
  for (std::size_t run = cell * runs; run < (cell + 1) * runs; ++run) {
    const std::optional<ClosedLoopMetrics> of_run = saved(run);
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

/// One line per contact source: the points of its curve, then the other metrics at the last point.
Table curve_table(const std::vector<SurvivalRow>& rows) {
  const SurvivalRow& first = rows.front();
  Table table{{fmt::format("{}, {}, {}", first.scene, first.cell.law,
                           simulators::simulator_title(first.cell.simulator))},
              {}};
  const auto curves = group_by(rows, [](const SurvivalRow& row) { return row.cell.contact; });
  for (const SurvivalRow& row : curves.front().rows) table.header.push_back(point_text(row));
  table.header.insert(table.header.end(),
                      {"slip (m/s)", "pitch (rad)", "force (N)", "false takeoffs/min"});
  for (const auto& curve : curves) {
    std::vector<std::string>& cells = table.rows.emplace_back(1, contact_title(curve.key));
    for (const SurvivalRow& row : curve.rows) {
      cells.push_back(fmt::format("{}/{}", row.metrics.finished, row.metrics.runs));
    }
    const ClosedLoopMetrics& end = curve.rows.back().metrics;
    cells.push_back(fmt::format("{:.2f}", end.landing_speed_rms()));
    cells.push_back(fmt::format("{:.2f}", end.mean_largest_pitch()));
    cells.push_back(fmt::format("{:.0f}", end.mean_largest_force()));
    cells.push_back(fmt::format("{:.1f}", end.false_takeoffs_per_minute()));
  }
  return table;
}

double rise_of(const SurvivalRow& row) {
  const bool is_rise = row.key == "rise" || row.key.ends_with(".rise");
  return is_rise ? row.cell.value : std::numeric_limits<double>::quiet_NaN();
}

Columns<ClosedLoopMetrics> metric_columns() {
  using Metrics = ClosedLoopMetrics;
  return Columns<Metrics>()
      .count("landings", &Metrics::landings)
      .metric("landing_speed_rms_mps", &Metrics::landing_speed_rms)
      .metric("largest_pitch_rad", &Metrics::mean_largest_pitch)
      .metric("largest_force_n", &Metrics::mean_largest_force)
      .metric("false_takeoffs_per_minute", &Metrics::false_takeoffs_per_minute);
}

Columns<SurvivalRow> survival_columns() {
  using Row = SurvivalRow;
  return Columns<Row>()
      .text("simulator", [](const Row& row) { return row.cell.simulator; })
      .text("scenario", &Row::scene)
      .as("scene")
      .text("policy", [](const Row& row) { return row.cell.law; })
      .text("contact", [](const Row& row) { return row.cell.contact; })
      .as("estimator")
      .level("rise_m", rise_of)
      .is(ColumnRole::note)
      .runs("runs", [](const Row& row) { return row.metrics.runs; })
      .interval("finished", &Row::finished)
      .text("varied", &Row::varied)
      .text("key", &Row::key)
      .level("value", [](const Row& row) { return row.cell.value; })
      .level("delay_ms", [](const Row& row) { return 1e3 * row.cell.delay; })
      .part([](const Row& row) { return row.cell.noise; }, noise_columns())
      .text("robot", &Row::robot)
      .text("sensors", &Row::sensors)
      .flag("is_oracle", [](const Row& row) { return row.cell.is_oracle(); })
      .is(ColumnRole::note)
      .count("fell", [](const Row& row) { return row.metrics.fell; })
      .count("won_against_always", &Row::won_against_always)
      .count("lost_against_always", &Row::lost_against_always)
      .part(&Row::metrics, metric_columns());
}

}  // namespace

std::vector<SurvivalRow> survival_rows(const RunRequest& request, const SavedMetrics& saved) {
  const Experiment& experiment = request.experiment;
  const auto& config = experiment.studies.at<ClosedLoopConfig>();
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
  directory.write_table("survival.csv", survival_columns(), rows);
}

std::string survival_text(const std::vector<SurvivalRow>& rows, const Experiment& experiment) {
  std::string text = fmt::format(
      "Finished runs of {}, by contact source of the policy{}; equal starts for all sources. At "
      "the last point: RMS slip speed of the tyres at landings, means over runs of the largest "
      "pitch and normal force, false takeoffs per minute of contact:\n",
      experiment.studies.at<ClosedLoopConfig>().runs, setup_caption(experiment));
  const auto table_of = [](const SurvivalRow& row) {
    return std::tuple(row.cell.scene, row.cell.simulator, row.cell.law);
  };
  for (const auto& alike : group_by(rows, table_of)) {
    text += fmt::format("\n{}", to_text(curve_table(alike.rows)));
  }
  return text;
}

}  // namespace touchdown::experiments
