#include <algorithm>
#include <limits>
#include <tuple>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/rows.hpp"
#include "experiments/results/odometry.hpp"
#include "experiments/results/scores.hpp"
#include "experiments/studies/closed_loop.hpp"
#include "scoring/bootstrap.hpp"
#include "simulators/registry.hpp"

namespace touchdown::experiments {

namespace {

/// What a scene varies, for tables and axes: "", the last part of a key as "rise", "delay",
/// "noise".
std::string varied_quantity(const ClosedLoopScene& scene) {
  if (scene.values.size() > 1) return scene.key.substr(scene.key.rfind('.') + 1);
  if (scene.delay.size() > 1) return "delay";
  return scene.noise.size() > 1 ? "noise" : "";
}

struct SurvivalRow {
  ClosedLoopCell cell;
  std::string scene;               ///< the scenario's name
  std::string robot;               ///< its file's stem
  std::string sensors;             ///< likewise; "ideal"
  std::string varied;              ///< `varied_quantity`
  std::string key;                 ///< of the scenario, with the cell's value; empty: none
  ClosedLoopMetrics metrics = {};  ///< of all runs
  Interval finished = {};          ///< share, with its exact interval
  /// Runs that finish here but not with the contact source `always`, at the same law, start and
  /// perturbations; and the reverse. Both 0 if `always` is not in the experiment.
  int won_against_always = 0;
  int lost_against_always = 0;
};

std::string stem(const std::string& file, const char* none) {
  return file.empty() ? none : std::filesystem::path(file).stem().string();
}

std::vector<ClosedLoopMetrics> metrics_of(std::size_t cell, const Evaluation& evaluation) {
  const ModelTasks& tasks = evaluation.plan.model_tasks_called("closed_loop");
  const auto runs =
      static_cast<std::size_t>(evaluation.request.experiment.studies.at<ClosedLoopConfig>().runs);
  std::vector<ClosedLoopMetrics> metrics;
  for (std::size_t run = cell * runs; run < (cell + 1) * runs; ++run) {
    const std::optional<std::string> bytes = saved_result(tasks, run, evaluation.saved);
    if (!bytes) throw Error(fmt::format("run {} of the closed loop is missing", run));
    std::string_view rest = *bytes;
    metrics.push_back(unpack<ClosedLoopMetrics>(rest));
  }
  return metrics;
}

/// The identity of a cell, without its contact source.
auto without_source(const ClosedLoopCell& cell) {
  return std::tie(cell.simulator, cell.law, cell.scene, cell.point);
}

/// Rows in the order of the cells.
std::vector<SurvivalRow> survival_rows(const Evaluation& evaluation) {
  const RunRequest& request = evaluation.request;
  const Experiment& experiment = request.experiment;
  const auto& config = experiment.studies.at<ClosedLoopConfig>();
  const std::vector<ClosedLoopCell> cells = closed_loop_cells(experiment);
  std::vector<std::vector<ClosedLoopMetrics>> by_cell;
  for (std::size_t i = 0; i < cells.size(); ++i) by_cell.push_back(metrics_of(i, evaluation));
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
      for (std::size_t run = 0; run < others.size(); ++run) {
        row.won_against_always += by_cell[i][run].finished > others[run].finished ? 1 : 0;
        row.lost_against_always += by_cell[i][run].finished < others[run].finished ? 1 : 0;
      }
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

double rise_of(const SurvivalRow& row) {
  const bool is_rise = row.key == "rise" || row.key.ends_with(".rise");
  return is_rise ? row.cell.value : std::numeric_limits<double>::quiet_NaN();
}

Columns<SurvivalRow> survival_columns() {
  using Row = SurvivalRow;
  using Metrics = ClosedLoopMetrics;
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
      .part(&Row::metrics,
            Columns<Metrics>()
                .count("landings", &Metrics::landings)
                .metric("landing_speed_rms_mps", &Metrics::landing_speed_rms)
                .metric("largest_pitch_rad", &Metrics::mean_largest_pitch)
                .metric("largest_force_n", &Metrics::mean_largest_force)
                .metric("false_takeoffs_per_minute", &Metrics::false_takeoffs_per_minute));
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
TextTable curve_table(const std::vector<SurvivalRow>& rows) {
  const SurvivalRow& first = rows.front();
  TextTable table{{fmt::format("{}, {}, {}", first.scene, first.cell.law,
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

FigureAxis axis_of(const std::string& varied) {
  if (varied == "delay") return {"delay_ms", "delay of contact feedback", "ms"};
  if (varied == "noise") return {"torque_noise_nm", "torque noise", "N·m"};
  if (varied == "rise") return {"value", "height of a step", "m"};
  if (varied == "velocity") return {"value", "commanded speed", "m/s"};
  return {"value", varied};
}

/// `varied`: empty if nothing is.
std::string caption_of(const std::string& runs, const std::string& varied, double level) {
  const bool has_curves = !varied.empty();
  return fmt::format(
      "{} runs{}, with the same initial conditions for all contact sources{} exact {:.0f} % "
      "intervals of the share of runs that finish; {}root mean square speed of the tyres over the "
      "ground at landings. Oracles read the simulator's state.",
      runs, has_curves ? " per point" : "", has_curves ? ". Bars:" : ";", 100.0 * level,
      has_curves ? "curves are shifted sideways a little. Below: " : "");
}

/// One scene under one law, with at most one varied quantity.
FigureSpec spec_of(const std::string& scene, const std::string& law, const std::string& varied,
                   const Table& survival, const Experiment& experiment) {
  FigureSpec spec;
  spec.name = fmt::format("survival_{}_{}{}{}", scene, law, varied.empty() ? "" : "_", varied);
  spec.table = "survival.csv";
  spec.where = {{"scenario", scene}, {"policy", law}, {"varied", varied}};
  const FigureGroups engines =
      groups_in(survival, "simulator", simulators::simulator_title, spec.where);
  const FigureGroups contacts = groups_in(survival, "contact", contact_title, spec.where);
  const FigureAxis finished{.column = "finished",
                            .title = "share of runs that finish",
                            .low = "finished_low",
                            .high = "finished_high",
                            .from = -0.02,
                            .to = 1.02};
  const FigureAxis landing_speed{.column = "landing_speed_rms_mps",
                                 .title = "tyre speed at landings",
                                 .unit = "m/s",
                                 .from = 0.0};
  if (varied.empty()) {
    spec.rows = contacts;
    spec.series = engines;
    spec.measures = {finished,
                     landing_speed,
                     {.column = "false_takeoffs_per_minute",
                      .title = "false takeoffs per minute of contact",
                      .from = 0.0}};
  } else {
    spec.panels = engines;
    spec.series = contacts;
    spec.colour_order = experiment.estimators;
    spec.x = axis_of(varied);
    spec.measures = {finished, landing_speed};
  }
  spec.alt = "Share of runs that finish." + values_text(spec, survival);
  return spec;
}

/// Figures by contact source: one for every scene, law and varied quantity,
/// `survival_<scene>_<law>[_<varied>]`.
std::vector<FigureSpec> survival_figures(const Table& survival, const Experiment& experiment) {
  const FigureGroups figures =
      combinations_in(survival, {"scenario", "policy", "varied", "sensors", "runs"},
                      [](const auto&) { return std::string(); });
  std::vector<FigureSpec> specs;
  for (const FigureGroup& of : figures.groups) {
    const std::string &scene = of.values[0], &law = of.values[1], &varied = of.values[2];
    FigureSpec& spec = specs.emplace_back(spec_of(scene, law, varied, survival, experiment));
    spec.title = fmt::format("Closed-loop results by contact source: {}, {}, {} sensors", scene,
                             law == "soft_landing" ? "soft landing" : law, of.values[3]);
    spec.caption = caption_of(of.values[4], varied, experiment.intervals.bootstrap.level);
  }
  return specs;
}

}  // namespace

StudyResult summarize_closed_loop(const Evaluation& evaluation, const RunDirectory& directory) {
  const Experiment& experiment = evaluation.request.experiment;
  const std::vector<SurvivalRow> rows = survival_rows(evaluation);
  const Table table = directory.write_table("survival.csv", survival_columns(), rows);
  return {{survival_text(rows, experiment)}, {}, survival_figures(table, experiment)};
}

}  // namespace touchdown::experiments
