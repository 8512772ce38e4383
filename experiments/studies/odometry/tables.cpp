#include "experiments/studies/odometry/tables.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/rows.hpp"
#include "experiments/results/captions.hpp"
#include "experiments/results/odometry.hpp"
#include "experiments/studies/odometry/plan.hpp"
#include "scoring/bootstrap.hpp"

namespace touchdown::experiments {

namespace {

/// The scores of one run by contact source, summed over noise seeds; empty for a failed run.
std::vector<scoring::TrajectoryScore> scores_of(const Evaluation& evaluation, std::size_t run) {
  std::vector<scoring::TrajectoryScore> all;
  for (const auto& found : measured<scoring::TrajectoryScore>(odometry_measure, run,
                                                              evaluation.plan, evaluation.saved)) {
    all.insert(all.end(), found.scores.begin(), found.scores.end());
  }
  return all;
}

/// Rows of one scene in one engine without scores, and the samples of each row: its runs.
struct SceneRows {
  std::vector<OdometryRow> rows;
  std::vector<std::vector<scoring::TrajectoryScore>> samples;
};

SceneRows scene_rows(const Evaluation& evaluation, const BenchmarkSetup& setup, std::size_t scene,
                     const std::string& simulator) {
  const Experiment& experiment = evaluation.request.experiment;
  const auto& config = experiment.studies.at<OdometryStudyConfig>();
  const RunGroup& group = evaluation.plan.groups[setup.group];
  const std::size_t oracles = oracle_names(config.delay).size();
  const scenarios::Scenario& scenario =
      scenario_of(evaluation.request, experiment.test.scenarios[scene]).scenario;
  SceneRows found;
  for (const std::string& contact : contact_sources_of(config, group, simulator)) {
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

Columns<OdometryRow> odometry_columns() {
  using Row = OdometryRow;
  using Score = scoring::TrajectoryScore;
  return Columns<Row>()
      .text("simulator", &Row::simulator)
      .text("scenario", &Row::scene)
      .as("scene")
      .text("contact", &Row::contact)
      .as("estimator")
      .interval("rms_m", &Row::rms)
      .interval("error_per_metre", &Row::error_per_metre)
      .text("robot", &Row::robot)
      .text("sensors", &Row::sensors)
      .flag("is_oracle", &Row::is_oracle)
      .is(ColumnRole::note)
      .part(&Row::score, Columns<Score>()
                             .metric("ate_m", &Score::ate)
                             .metric("rpe_m", &Score::rpe)
                             .metric("height_rms_m", &Score::height_rms)
                             .metric("velocity_rms_mps", &Score::velocity_rms)
                             .metric("end_per_metre", &Score::end_per_metre)
                             .metric("distance_m", &Score::distance))
      .runs("runs", &Row::runs)
      .count("failed", &Row::failed);
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
  directory.write_table("odometry.csv", odometry_columns(), rows);
}

std::string odometry_text(const std::vector<OdometryRow>& rows, const Experiment& experiment) {
  std::string text = fmt::format("Odometry by contact source ({}; {}):\n", labels_text(experiment),
                                 intervals_text(experiment));
  const auto title = [](const OdometryRow& row) {
    return fmt::format("{}, {}, {} sensors, {}", row.scene, row.robot, row.sensors, row.simulator);
  };
  for (const auto& [heading, alike] : group_by(rows, title)) {
    Table table{{heading, "RMS (m)", "error per metre (%)", "height (m)", "velocity (m/s)"}, {}};
    for (const OdometryRow& row : alike) {
      table.rows.push_back({contact_title(row.contact), with_interval(row.rms),
                            in_percent(row.error_per_metre),
                            fmt::format("{:.3f}", row.score.height_rms()),
                            fmt::format("{:.3f}", row.score.velocity_rms())});
    }
    text += fmt::format("\n{}", to_text(table));
  }
  return text;
}

}  // namespace touchdown::experiments
