#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "core/interval.hpp"
#include "experiments/evaluation/joint_bootstrap.hpp"
#include "experiments/studies/study.hpp"
#include "scoring/extended_score.hpp"

namespace touchdown::experiments {

/// The section `benchmark`: robots and sensors in addition to the experiment's own. Every estimator
/// is fitted to and tested on each combination. Every scene is scored separately.
struct BenchmarkConfig {
  std::vector<std::string> robots;   ///< files
  std::vector<std::string> sensors;  ///< likewise
  /// Whether estimators fitted on another robot, other sensors or the other engine are scored, too.
  bool transfer = false;
  /// How often every fit is repeated, each time with a bootstrap resample of the fitted runs.
  /// Intervals then include the variation due to the choice of fitted runs.
  int refits = 0;
  /// Whether refits cover all robots and sensors, or only the experiment's own.
  bool refits_everywhere = false;
  /// Whether the worst segment of every estimator is filmed, on the experiment's own robot.
  bool clips = false;
  /// The estimators of the Markdown table of unseen scenes; empty: all that are ranked.
  std::vector<std::string> table;
};

/// A robot with its sensors, by their names in tables.
struct BenchmarkSetup {
  std::string robot;      ///< "upkie_heavy"; the experiment's own is that of its first scenario
  std::string sensors;    ///< "harsh", "ideal"
  RunSetup runs;          ///< in the plan
  std::size_t group = 0;  ///< of its runs in the plan
};

/// Every combination of a robot and sensors, the experiment's own first.
std::vector<BenchmarkSetup> benchmark_setups(const RunRequest& request, const Plan& plan);

inline constexpr std::string_view extended_measure = "extended";

/// Measures extended scores, of type `scoring::ExtendedScore`, of every prediction but those of
/// refits.
Measure extended_scores();

/// One estimator in one scene, on one robot with its sensors, in one engine and noise setting; both
/// wheels added.
struct BenchmarkRow {
  std::string simulator;
  std::string robot;
  std::string sensors;
  std::string scene;
  /// "test": other draws of this scene are in the fit; "unseen": none are.
  std::string split;
  noise::NoiseCell noise = {};
  std::string estimator;
  /// Where the estimator was fitted: "own", or the name of another engine or setup.
  std::string fitted_on;
  Resampled balanced_accuracy = {};
  scoring::Score score = {};
  scoring::ExtendedScore extended = {};
  double air = 0.0;        ///< time of true air in the scored runs, both wheels added (s)
  std::size_t refits = 0;  ///< resampled together with the runs
  int runs = 0;            ///< simulated
  int failed = 0;          ///< of these; not scored

  bool is_scored() const { return !std::isnan(balanced_accuracy.estimate); }
};

/// A scene with less true air says nothing about how well it is found (s).
inline constexpr double least_air = 0.1;

/// The scores of a submitted estimator in one run with one noise realisation.
struct SubmittedRun {
  std::uint64_t task = 0;                       ///< index in the plan
  std::uint64_t cell = 0;                       ///< index in the experiment's highlights
  std::vector<scoring::RobotScore> score = {};  ///< by segment of the run
  scoring::ExtendedScore extended = {};

  static auto members(auto& run) { return std::tie(run.task, run.cell, run.score, run.extended); }
};

/// Saves the scores of a submitted estimator, by task; replaces those of the same name.
void save(const std::string& name, const std::vector<SubmittedRun>& runs, const Store& store);

/// Rows by setup, scene, engine, estimator, then noise. If every run of a scene failed, its scores
/// are NaN. Rows of submitted estimators that were scored in this run directory follow the others,
/// by estimator. `runs` of such a row counts runs with submitted beliefs, and failed runs.
std::vector<BenchmarkRow> benchmark_rows(const Evaluation& evaluation,
                                         const RunDirectory& directory);

/// The ranking of estimators on one robot with its sensors, at one noise setting, in both engines.
struct Standings {
  std::string robot;
  std::string sensors;
  noise::NoiseCell noise;

  /// One estimator over all scenes and engines, with equal weights.
  struct Entry {
    std::string estimator;
    scoring::Score score;  ///< of all scenes and engines, both wheels added
    Interval event_f1;     ///< of that score; scenes are resampled
    Interval mean;         ///< of balanced accuracy; scenes, fits and runs are resampled
    double worst = 0.0;    ///< lowest balanced accuracy over scenes and engines
    std::string worst_scene;
    std::string worst_simulator;
    /// Whether the simultaneous band of its balanced accuracy's difference from the best one
    /// includes zero.
    bool is_not_significantly_worse = false;
    /// Mean log loss over scenes and engines (bits per wheel and step).
    double log_loss = 0.0;
    std::size_t scored = 0;   ///< pairs of scene and engine with a scored run
    std::size_t planned = 0;  ///< pairs of scene and engine
    /// Of the scored pairs, those with too little air: they count in no balanced accuracy, unless
    /// all have too little.
    std::size_t without_air = 0;
  };
  std::vector<Entry> entries;  ///< by F1 of events, the best first

  /// Balanced accuracy of the first estimator minus that of the second, on the same runs, resampled
  /// together: the mean over engines in one scene; or, if `scene` is empty, over scenes, which are
  /// resampled, too, and engines.
  struct Difference {
    std::string scene;
    std::string first;
    std::string second;
    Interval value;
  };
  /// All pairs, by scene. The bands of a scene hold simultaneously. Their half-width in standard
  /// errors is the 95 % quantile, over resamples, of the largest deviation of any pair.
  std::vector<Difference> differences;
};

/// Standings of in-domain estimators that were scored in every scored run. Those over the unseen
/// scenes alone have differences of means only, and are empty without such scenes.
std::vector<Standings> standings(const std::vector<BenchmarkRow>& rows,
                                 const scoring::BootstrapConfig& intervals,
                                 bool only_unseen = false);

/// Standings over unseen scenes as a Markdown table for pages: a row per estimator of
/// `benchmark.table`, on the first robot with its sensors. Each noise setting has a column with F1
/// and its interval; the others have the numbers of all settings.
/// Empty without standings.
std::string unseen_markdown(const std::vector<Standings>& unseen, const Experiment& experiment);

/// The rankings of `benchmark_standings.csv`: a figure for every robot with its sensors,
/// `benchmark_<robot>_<sensors>`. A ring marks a balanced accuracy that is not significantly worse
/// than the best.
std::vector<FigureSpec> standings_figures(const Table& standings, const Experiment& experiment);

/// Writes the tables of a benchmark with its submissions. Returns the text for the terminal:
/// standings for every robot with its sensors, and scores by scene for the experiment's own.
std::string write_benchmark(const Evaluation& evaluation, const RunDirectory& directory);

}  // namespace touchdown::experiments
