#include "experiments/studies/odometry/tables.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/tables/table.hpp"
#include "experiments/odometry/contact_sources.hpp"
#include "experiments/results/captions.hpp"
#include "experiments/studies/odometry/plan.hpp"
#include "scoring/bootstrap.hpp"

namespace touchdown::experiments {

namespace {

/// The scores of one run by contact source, summed over noise seeds; empty for a failed run.
std::vector<scoring::TrajectoryScore> scores_of(const Evaluation& evaluation, std::size_t run) {
  std::vector<scoring::TrajectoryScore> sums;
  for (const TaskCounts& found : task_counts_of(run, evaluation.plan, evaluation.saved)) {
    sums.resize(std::max(sums.size(), found.odometry.size()));
    for (std::size_t i = 0; i < found.odometry.size(); ++i) sums[i] += found.odometry[i];
  }
  return sums;
}

/// Rows of one scene in one engine without scores, and the samples of each row: its runs.
struct SceneRows {
  std::vector<OdometryRow> rows;
  std::vector<std::vector<scoring::TrajectoryScore>> samples;
};

SceneRows scene_rows(const Evaluation& evaluation, const BenchmarkSetup& setup, std::size_t scene,
                     const std::string& simulator) {
  const Experiment& experiment = evaluation.request.experiment;
  const RunGroup& group = evaluation.plan.groups[setup.group];
  const std::size_t oracles = oracle_names(*group.odometry).size();
  const scenarios::Scenario& scenario =
      scenario_of(evaluation.request, experiment.test.scenarios[scene]).scenario;
  SceneRows found;
  for (const std::string& contact : contact_sources_of(group, simulator)) {
    OdometryRow row;
    row.simulator = simulator;
    row.scene = scenario.name;
    row.contact = contact;
    row.is_oracle = found.rows.size() < oracles;
    row.robot = setup.robot;
    row.sensors = setup.sensors;
    found.rows.push_back(row);
  }
  found.samples.resize(found.rows.size());
  for (const std::size_t index : evaluation.plan.runs_in(setup.group)) {
    const PlannedRun& run = evaluation.plan.runs[index];
    const bool is_its_own = run.simulator == simulator && scene_of(run, experiment) == scene;
    if (!is_its_own) continue;
    const bool failed = evaluation.runs.at(index).failed();
    const std::vector<scoring::TrajectoryScore> scores = scores_of(evaluation, index);
    for (std::size_t i = 0; i < found.rows.size(); ++i) {
      ++found.rows[i].runs;
      found.rows[i].failed += failed ? 1 : 0;
      if (!failed) found.samples[i].push_back(scores.at(i));
    }
  }
  return found;
}

std::string in_percent(const Interval& share) {
  return with_interval({100.0 * share.estimate, 100.0 * share.low, 100.0 * share.high}, 2);
}

}  // namespace

std::vector<OdometryRow> odometry_rows(const Evaluation& evaluation) {
  const Experiment& experiment = evaluation.request.experiment;
  using Score = scoring::TrajectoryScore;
  const std::vector<std::function<double(const Score&)>> statistics = {
      [](const Score& score) { return score.rms(); },
      [](const Score& score) { return score.error_per_metre(); }};
  std::vector<OdometryRow> all;
  for (const BenchmarkSetup& setup : odometry_setups(evaluation.request, evaluation.plan)) {
    for (std::size_t scene = 0; scene < experiment.test.scenarios.size(); ++scene) {
      for (const std::string& simulator : experiment.simulators) {
        SceneRows found = scene_rows(evaluation, setup, scene, simulator);
        for (std::size_t i = 0; i < found.rows.size(); ++i) {
          const std::vector<Interval> intervals = scoring::bootstrap<Score>(
              found.samples[i], statistics, experiment.intervals.bootstrap);
          found.rows[i].rms = intervals[0];
          found.rows[i].error_per_metre = intervals[1];
          found.rows[i].score = scoring::sum(found.samples[i]);
        }
        std::stable_sort(found.rows.begin(), found.rows.end(), [](const auto& a, const auto& b) {
          return a.rms.estimate < b.rms.estimate;
        });
        all.insert(all.end(), found.rows.begin(), found.rows.end());
      }
    }
  }
  return all;
}

void write_tables(const std::vector<OdometryRow>& rows, const RunDirectory& directory) {
  Table table{{"simulator",
               "scenario",
               "contact",
               "rms_m",
               "rms_m_low",
               "rms_m_high",
               "error_per_metre",
               "error_per_metre_low",
               "error_per_metre_high",
               "robot",
               "sensors",
               "is_oracle",
               "ate_m",
               "rpe_m",
               "height_rms_m",
               "velocity_rms_mps",
               "end_per_metre",
               "distance_m",
               "runs",
               "failed"},
              {}};
  for (const OdometryRow& row : rows) {
    const scoring::TrajectoryScore& score = row.score;
    table.rows.push_back({row.simulator, row.scene, row.contact});
    std::vector<std::string>& cells = table.rows.back();
    for (const Interval& interval : {row.rms, row.error_per_metre}) {
      for (const double value : {interval.estimate, interval.low, interval.high}) {
        cells.push_back(metric(value));
      }
    }
    cells.insert(cells.end(), {row.robot, row.sensors, row.is_oracle ? "1" : "0"});
    for (const double value : {score.ate(), score.rpe(), score.height_rms(), score.velocity_rms(),
                               score.end_per_metre(), score.distance}) {
      cells.push_back(metric(value));
    }
    cells.insert(cells.end(), {std::to_string(row.runs), std::to_string(row.failed)});
  }
  directory.write_table("odometry.csv", table);
}

std::string odometry_text(const std::vector<OdometryRow>& rows, const Experiment& experiment) {
  std::string text = fmt::format("Odometry by contact source ({}; {}):\n", labels_text(experiment),
                                 intervals_text(experiment));
  Table table;
  for (auto row = rows.begin(); row != rows.end(); ++row) {
    if (table.rows.empty()) {
      table.header = {fmt::format("{}, {}, {} sensors, {}", row->scene, row->robot, row->sensors,
                                  row->simulator),
                      "RMS (m)", "error per metre (%)", "height (m)", "velocity (m/s)"};
    }
    table.rows.push_back({contact_title(row->contact), with_interval(row->rms),
                          in_percent(row->error_per_metre),
                          fmt::format("{:.3f}", row->score.height_rms()),
                          fmt::format("{:.3f}", row->score.velocity_rms())});
    const auto next = row + 1;
    const bool is_last = next == rows.end() || next->scene != row->scene ||
                         next->simulator != row->simulator || next->robot != row->robot ||
                         next->sensors != row->sensors;
    if (!is_last) continue;
    text += fmt::format("\n{}", to_text(table));
    table = {};
  }
  return text;
}

}  // namespace touchdown::experiments
