#include "experiments/results/odometry.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/rows.hpp"
#include "experiments/config/experiment_yaml.hpp"
#include "experiments/evaluation/joint_bootstrap.hpp"
#include "experiments/figures/figure_spec.hpp"
#include "experiments/results/captions.hpp"
#include "experiments/studies/benchmark.hpp"
#include "experiments/studies/registry.hpp"
#include "scoring/bootstrap.hpp"
#include "simulators/registry.hpp"

namespace touchdown::experiments {

namespace {

/// The section `odometry`: odometry on every test run, with contact from every estimator, from the
/// ground truth, and from the ground truth with these delays (docs/explanation/odometry.md).
struct OdometryStudyConfig {
  std::vector<double> delay;  ///< s
};

void describe(Fields& fields, OdometryStudyConfig& odometry, const Experiment& /*experiment*/) {
  fields.in_line("delay", odometry.delay)
      .range("above 0, to 1")
      .doc("s", "Delays of true contact; odometry runs with each.");
  for (auto delay = odometry.delay.begin(); delay != odometry.delay.end(); ++delay) {
    fields.check(*delay > 0.0 && *delay <= 1.0, "delay", "expected times between 0 and 1 s");
    fields.check(std::find(odometry.delay.begin(), delay, *delay) == delay, "delay",
                 fmt::format("{} appears twice", *delay));
  }
}

/// Measures of odometry: scores of type `scoring::TrajectoryScore`, and trajectories as TUM texts.
constexpr std::string_view odometry_measure = "odometry";
constexpr std::string_view trajectory_measure = "trajectories";

Measure scores_measure(const OdometryStudyConfig& config, const std::string& fit) {
  using Scores = std::vector<scoring::TrajectoryScore>;
  const auto score = [](const MeasuredRun& run, const TrackView& p_contact) {
    return score_odometry(run.signals, run.noise, run.cells.front().levels(), p_contact,
                          run.scoring);
  };
  Measure measure;
  measure.name = odometry_measure;
  measure.of_run = [config, score](const MeasuredRun& run) {
    Scores scores;
    for (const ContactTrack& track : oracle_tracks(config.delay, run.signals)) {
      scores.push_back(score(run, {track[0], track[1]}));
    }
    return pack(scores);
  };
  measure.of_prediction = [fit, score](const MeasuredPrediction& made) {
    if (made.cell > 0 || !made.condition.is_fitted_in_domain(fit)) return std::string();
    return pack(
        Scores{score(made.run, {made.prediction[0].p_contact, made.prediction[1].p_contact})});
  };
  return measure;
}

/// The setups of the odometry study: the experiment's own, and those of a benchmark.
std::vector<BenchmarkSetup> odometry_setups(const RunRequest& request, const Plan& plan) {
  if (request.experiment.studies.has<BenchmarkConfig>()) return benchmark_setups(request, plan);
  RunRequest alone = request;
  alone.experiment.studies.emplace<BenchmarkConfig>();
  return benchmark_setups(alone, plan);
}

/// The contact sources of odometry in one setup and engine, by their names in tables, in the order
/// of the scores of a run.
std::vector<std::string> contact_sources_of(const OdometryStudyConfig& config,
                                            const RunGroup& group, const std::string& simulator) {
  std::vector<std::string> names = oracle_names(config.delay);
  for (const Condition& condition : tested_on(group.conditions, simulator)) {
    if (condition.is_fitted_in_domain(group.fit)) {
      names.push_back(contact_name(condition.estimator));
    }
  }
  return names;
}

constexpr double spacing = 0.01;  // s
constexpr char end_of_text = '\0';

/// The scored part of a run as texts.
class Texts {
 public:
  explicit Texts(const MeasuredRun& run)
      : run_(run),
        first_(scoring::first_scored_step(run.signals.info.control_period_us, run.scoring)) {}

  /// Whether it is the first of a scene's `runs` with the first noise realisation, and not empty.
  bool are_wanted(int runs) const {
    return run_.seed == 0 && run_.signals.info.run % runs == 0 && first_ < run_.signals.steps();
  }

  std::string truth() const { return text(scored(run_.signals.motion->truth)); }

  std::string with_contact(const TrackView& p_contact) const {
    const scoring::Trajectory estimate =
        scored(dead_reckoned(run_.signals, run_.noise, run_.cells.front().levels(), p_contact));
    return text(scoring::aligned_at_start(estimate, run_.signals.motion->truth[first_]));
  }

 private:
  scoring::Trajectory scored(const scoring::Trajectory& whole) const {
    return {whole.begin() + static_cast<std::ptrdiff_t>(first_), whole.end()};
  }
  std::string text(const scoring::Trajectory& trajectory) const {
    const auto period = static_cast<double>(run_.signals.info.control_period_us);
    const auto stride =
        static_cast<std::size_t>(std::max(1LL, std::llround(1e6 * spacing / period)));
    return scoring::to_tum(trajectory, stride) + end_of_text;
  }

  const MeasuredRun& run_;
  std::size_t first_;
};

/// Measures the trajectories of each scene's first run with the first noise realisation, as TUM
/// texts: of the run the true one and those of the oracles, of each in-domain prediction its own. A
/// text has a pose every 10 ms; all have the same first pose. `runs` is the number of test runs of
/// a scene.
Measure trajectories(const OdometryStudyConfig& config, int runs) {
  Measure measure;
  measure.name = trajectory_measure;
  measure.of_run = [config, runs](const MeasuredRun& run) {
    const Texts texts(run);
    if (!texts.are_wanted(runs)) return std::string();
    std::string all = texts.truth();
    for (const ContactTrack& track : oracle_tracks(config.delay, run.signals)) {
      all += texts.with_contact({track[0], track[1]});
    }
    return all;
  };
  measure.of_prediction = [runs](const MeasuredPrediction& made) {
    const Texts texts(made.run);
    const bool is_measured = made.cell == 0 && made.condition.is_fitted_in_domain();
    if (!is_measured || !texts.are_wanted(runs)) return std::string();
    return texts.with_contact({made.prediction[0].p_contact, made.prediction[1].p_contact});
  };
  return measure;
}

/// Writes them as `trajectories/<engine>_<scene>_<contact>.tum` and `…_ground_truth.tum`, the
/// format of `evo`. Failed runs are left out.
void write_trajectories(const Evaluation& evaluation, const RunDirectory& directory) {
  const Plan& plan = evaluation.plan;
  for (const Task& task : plan.tasks) {
    const PlannedRun& run = plan.runs[task.run];
    if (run.group != 0 || task.seed != 0) continue;
    const std::optional<TaskCounts> counts = saved_counts(plan, task, evaluation.saved);
    if (!counts) throw Error(fmt::format("the results of {} are missing", task_name(plan, task)));
    std::string texts;
    for (const MeasuredBytes& found : counts->measured) {
      if (found.measure == trajectory_measure) texts += found.bytes;
    }
    if (texts.empty()) continue;
    std::vector<std::string> names =
        contact_sources_of(evaluation.request.experiment.studies.at<OdometryStudyConfig>(),
                           plan.groups.front(), run.simulator);
    names.insert(names.begin(), "ground_truth");
    std::size_t begin = 0;
    for (const std::string& name : names) {
      const std::size_t end = texts.find(end_of_text, begin);
      if (end == std::string::npos) throw Error("a state file is too short");
      write_atomically(directory.own_file("trajectories", fmt::format("{}_{}_{}.tum", run.simulator,
                                                                      run.scenario.name, name)),
                       texts.substr(begin, end - begin));
      begin = end + 1;
    }
  }
}

/// The scores of odometry in one scene and engine, with one contact source.
struct OdometryRow {
  std::string simulator;
  std::string scene;
  std::string contact;  ///< the source: "always", "truth", "truth_delayed_20ms", an estimator
  bool is_oracle = false;
  std::string robot;
  std::string sensors;
  std::vector<scoring::TrajectoryScore> samples;  ///< of each scored run
  scoring::TrajectoryScore score;                 ///< of all of them
  Interval rms;                                   ///< m
  Interval error_per_metre;                       ///< m/m
  int runs = 0;
  int failed = 0;  ///< of these; not scored
};

/// Rows of one scene in one engine, with the scores of their runs.
std::vector<OdometryRow> scored_rows(const Evaluation& evaluation, const BenchmarkSetup& setup,
                                     std::size_t scene, const std::string& simulator) {
  const Experiment& experiment = evaluation.request.experiment;
  const auto& config = experiment.studies.at<OdometryStudyConfig>();
  const std::size_t oracles = oracle_names(config.delay).size();
  std::vector<OdometryRow> rows;
  for (const std::string& contact :
       contact_sources_of(config, evaluation.plan.groups[setup.group], simulator)) {
    OdometryRow& row = rows.emplace_back();
    row.simulator = simulator;
    row.scene = scenario_of(evaluation.request, experiment.test.scenarios[scene]).scenario.name;
    row.contact = contact;
    row.is_oracle = rows.size() <= oracles;
    row.robot = setup.robot;
    row.sensors = setup.sensors;
  }
  for (const std::size_t index : evaluation.plan.runs_in(setup.group, simulator)) {
    if (scene_of(evaluation.plan.runs[index], experiment) != scene) continue;
    const bool failed = evaluation.runs.at(index).failed();
    const auto scores = rows_of<scoring::TrajectoryScore>(odometry_measure, {&index, 1},
                                                          evaluation.plan, evaluation.saved);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      ++rows[i].runs;
      rows[i].failed += failed ? 1 : 0;
      if (!failed) rows[i].samples.push_back(scores.at(i).score);
    }
  }
  return rows;
}

/// Setup by setup, scene by scene, engine by engine; the best first.
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
        std::vector<OdometryRow> rows = scored_rows(evaluation, setup, scene, simulator);
        for (OdometryRow& row : rows) {
          const std::vector<Interval> intervals =
              scoring::bootstrap<Score>(row.samples, statistics, experiment.intervals.bootstrap);
          row.rms = intervals[0];
          row.error_per_metre = intervals[1];
          row.score = scoring::sum(row.samples);
        }
        std::ranges::stable_sort(
            rows, [](const auto& a, const auto& b) { return a.rms.estimate < b.rms.estimate; });
        all.insert(all.end(), rows.begin(), rows.end());
      }
    }
  }
  return all;
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

std::string in_percent(const Interval& share) {
  return with_interval({100.0 * share.estimate, 100.0 * share.low, 100.0 * share.high}, 2);
}

std::string odometry_text(const std::vector<OdometryRow>& rows, const Experiment& experiment) {
  std::string text = fmt::format("Odometry by contact source ({}; {}):\n", labels_text(experiment),
                                 intervals_text(experiment));
  const auto title = [](const OdometryRow& row) {
    return fmt::format("{}, {}, {} sensors, {}", row.scene, row.robot, row.sensors, row.simulator);
  };
  for (const auto& [heading, alike] : group_by(rows, title)) {
    TextTable table{{heading, "RMS (m)", "error per metre (%)", "height (m)", "velocity (m/s)"},
                    {}};
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

/// The contact sources by their mean error over scenes and engines, the best first.
FigureGroups ranked_contacts(const Table& odometry, const FigureSpec& spec) {
  std::map<std::string, double> sums;
  for (const TableRow& row : odometry.all()) {
    const double error = drawn_value(spec.measures.front(), row);
    if (!passes(row, spec.where) || std::isnan(error)) continue;
    sums[row.text("contact")] += error;
  }
  FigureGroups contacts = groups_in(odometry, "contact", contact_title, spec.where);
  std::ranges::stable_sort(contacts.groups, [&](const FigureGroup& a, const FigureGroup& b) {
    return sums[a.values.front()] < sums[b.values.front()];
  });
  return contacts;
}

/// The best contact source above: a figure for every robot with its sensors,
/// `odometry_<robot>_<sensors>`.
std::vector<FigureSpec> odometry_figures(const Table& odometry, const Experiment& experiment) {
  const FigureGroups setups =
      combinations_in(odometry, {"robot", "sensors"}, [](const auto&) { return std::string(); });
  std::vector<FigureSpec> specs;
  for (const FigureGroup& setup : setups.groups) {
    const std::string& robot = setup.values[0];
    const std::string& sensors = setup.values[1];
    FigureSpec spec{.name = fmt::format("odometry_{}_{}", robot, sensors), .table = "odometry.csv"};
    spec.where = {{"robot", robot}, {"sensors", sensors}};
    spec.measures = {{.column = "rms_m",
                      .title = "RMS error",
                      .unit = "m",
                      .low = "rms_m_low",
                      .high = "rms_m_high",
                      .from = 0.0}};
    spec.panels = groups_in(
        odometry, "scenario", [](const auto& scene) { return scene; }, spec.where);
    spec.series = groups_in(odometry, "simulator", simulators::simulator_title, spec.where);
    spec.rows = ranked_contacts(odometry, spec);
    spec.title = fmt::format("Odometry error by contact source: {}, {} sensors", robot, sensors);
    spec.caption = fmt::format(
        "Root mean square error of the horizontal position along the run, starting from the true "
        "pose, with {:.0f} % bootstrap intervals over runs. All sources use the same filter and "
        "the same sensors. Oracles repeat the true contact, with or without a delay.",
        100.0 * experiment.intervals.bootstrap.level);
    spec.alt = "Root mean square error of odometry." + values_text(spec, odometry);
    specs.push_back(std::move(spec));
  }
  return specs;
}

class OdometryStudy final : public SectionStudy<OdometryStudyConfig> {
 public:
  std::optional<StudySection> section() const override {
    return optional_section<OdometryStudyConfig>("odometry",
                                                 "Odometry on every test run, by contact source.");
  }

  /// Adds the scores to the test runs of all setups, with contact from the oracles, then from each
  /// in-domain condition in the first scored noise setting.
  void plan(const RunRequest& request, Plan& plan) const override {
    const OdometryStudyConfig& config = section_of(request.experiment);
    plan.needs_motion = true;
    for (const BenchmarkSetup& setup : odometry_setups(request, plan)) {
      RunGroup& group = plan.groups[setup.group];
      add_measure(scores_measure(config, group.fit), group);
    }
    add_measure(trajectories(config, request.experiment.test.runs), plan.groups.front());
  }

  StudyResult summarize(const Evaluation& evaluation,
                        const RunDirectory& directory) const override {
    const Experiment& experiment = evaluation.request.experiment;
    const std::vector<OdometryRow> rows = odometry_rows(evaluation);
    const Table table = directory.write_table("odometry.csv", odometry_columns(), rows);
    write_trajectories(evaluation, directory);
    return {{odometry_text(rows, experiment)}, {}, odometry_figures(table, experiment)};
  }
};

}  // namespace

std::unique_ptr<const Study> odometry_study() { return std::make_unique<const OdometryStudy>(); }

}  // namespace touchdown::experiments
