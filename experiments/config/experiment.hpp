#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/keys/key.hpp"
#include "core/yaml.hpp"
#include "experiments/estimators/entry.hpp"
#include "noise/grid.hpp"
#include "scoring/bootstrap.hpp"
#include "scoring/labels.hpp"
#include "scoring/operating_point.hpp"
#include "scoring/transitions.hpp"

namespace touchdown::experiments {

/// The runs to simulate: each scenario `runs` times.
struct RunsConfig {
  std::vector<std::string> scenarios;  ///< scenario files
  int runs = 1;                        ///< of each scenario
  bool perturbed = true;               ///< whether perturbations are drawn from the seed
};

/// Training segments of perturbed runs of one scene, simulated at the control period of the test
/// runs.
struct TrainingSegments {
  std::string scenario;  ///< scenario file
  int runs = 1;
  double after = 0.3;   ///< earliest start of a segment (s)
  double length = 5.0;  ///< s, less if the run ends earlier
  /// Number of evenly spaced start times. Runs take them in turn; a segment with the last one ends
  /// with its run.
  int offsets = 1;
};

/// The section `fit.tuning`: every estimator with hyperparameters gets the same number of trials.
/// Only fitted runs decide which trial is best (docs/benchmark.md).
struct TuningConfig {
  int trials = 8;  ///< the first one has the estimator's defaults
  int folds = 2;   ///< of the fitted runs, for cross-validation
  std::vector<noise::NoiseCell> noise = {
      {}};  ///< noise settings of trials, in addition to the sensor model
  /// Whether a benchmark's other robots and sensors have trials of their own. Otherwise they use
  /// the values chosen for the experiment's own robot and sensors.
  bool everywhere = false;
};

/// Which recordings the run directory keeps. A run without a recording is simulated again where it
/// is needed, with identical results.
enum class KeptRecordings : int {
  all,
  pictured,  ///< those of films and of figures of drops
  none
};

/// The run that is plotted and filmed for every engine.
struct VideoConfig {
  bool enabled = true;
  int run = 0;                          ///< index of the test run
  std::vector<std::string> estimators;  ///< with probabilities shown; empty: the first one
  double torque_noise = 0.0;            ///< N·m
  double accelerometer_noise = 0.0;     ///< m/s²
};

/// Which flights count as drops: those of both wheels at once, or those of one wheel.
enum class DropWheels : int { both, left, right };

/// One drop of one test run, or a time in it, and the shown time around it. Drops are numbered from
/// 0, as `drops` finds them.
struct DropChoice {
  int run = 0;
  DropWheels wheels = DropWheels::both;
  int drop = 0;
  std::optional<double> at = {};  ///< s since the run's start, instead of a drop
  int seed = 0;                   ///< number of the study's noise realisation
  double before = 0.15;           ///< shown before takeoff or `at` (s)
  double after = 0.45;            ///< shown after it (s)
};

/// The section `detail`: a figure of the signals and the estimates during one drop, for every
/// engine.
struct DetailConfig {
  DropChoice choice = {};
  std::vector<noise::NoiseCell> noise = {{0.25, 1.0}, {1.0, 5.0}};  ///< one column of panels each
  std::vector<std::string> estimators = {};                         ///< with probabilities shown
};

/// The section `posterior`: a figure of the phase filter's probability of every phase during one
/// drop, for every engine.
struct PosteriorConfig {
  DropChoice choice = {};
  noise::NoiseCell noise = {1.0, 5.0};
};

/// One quantity of the scenario that is varied, with all others unchanged.
struct Factor {
  std::string name;
  std::string key;                      ///< of the scenario, dotted: `terrain.friction`
  std::vector<double> values;           ///< in the key's own unit
  std::vector<std::string> simulators;  ///< engines with this quantity; empty: all
};

/// The conditions for an estimator's verdict.
struct VerdictConfig {
  /// Fitted in the other engine, it must lose less accuracy than this (upper end of the paired
  /// interval).
  double largest_loss = 0.01;
  /// Fitted in the other engine, it must exceed always contact by more than this (lower end).
  double smallest_gain = 0.0;
  std::vector<std::string> demanded;  ///< estimators that must pass, or the run fails
};

/// The drop that is plotted in both engines.
struct OverlayConfig {
  int run = 0;   ///< index of the test run
  int drop = 3;  ///< of that run, from 0
};

/// The section `cross_simulator`: how much the results depend on the engine.
struct CrossSimulatorConfig {
  std::vector<Factor> factors;
  int sensitivity_runs = 4;  ///< test runs per engine and value of a factor, at most
  VerdictConfig verdict;
  OverlayConfig overlay;
};

/// A disturbance of the sensors that is varied, with all others unchanged.
struct SensorFactor {
  std::string key;             ///< a key of `noise::with_value`
  std::vector<double> values;  ///< in its own unit
};

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
};

/// The section `odometry`: odometry on every test run, with contact from every estimator, from the
/// ground truth, and from the ground truth with these delays (docs/odometry.md).
struct OdometryStudyConfig {
  std::vector<double> delay;  ///< s
};

/// The section `operating_points`: scores of every estimator with these thresholds instead of its
/// own. Each `leave_below` is paired with each `return_above` that is not lower (docs/metrics.md).
struct OperatingPointsConfig {
  std::vector<double> leave_below = {0.02, 0.05, 0.1, 0.15, 0.25, 0.4, 0.5, 0.6, 0.75, 0.85, 0.95};
  std::vector<double> return_above = {0.25, 0.5, 0.75, 0.9, 0.98};
};

/// The pairs of thresholds.
std::vector<scoring::Hysteresis> points_of(const OperatingPointsConfig& config);

/// A closed-loop scene with at most one varied quantity: a number of the scenario, the sensor
/// noise, or the delay of the contact signal.
struct ClosedLoopScene {
  std::string scenario;  ///< scenario file
  std::string key = {};  ///< of the scenario, dotted: `terrain.pieces.1.stairs.rise`; empty: none
  std::vector<double> values;                  ///< in the key's own unit
  std::vector<noise::NoiseCell> noise = {{}};  ///< in addition to the sensor model
  std::vector<double> delay = {0.0};           ///< s
};

/// The run that is filmed with several contact sources side by side.
struct ClosedLoopFilm {
  int scene = 0;                     ///< index of the scene, from 0
  int point = 0;                     ///< index of the varied value, from 0
  int run = 0;                       ///< index of the run
  std::string law;                   ///< one of the section's laws
  std::vector<std::string> contact;  ///< one to four contact sources
};

/// The section `closed_loop`: runs of a policy with contact from an estimator, from the ground
/// truth or without contact feedback (docs/closed_loop.md).
struct ClosedLoopConfig {
  std::vector<std::string> laws = {"soft_landing"};  ///< of policies
  std::vector<std::string> contact;  ///< contact sources: `truth`, `always`, estimators
  std::vector<ClosedLoopScene> scenes;
  int runs = 8;  ///< per scene and value, the same for all contact sources
  std::optional<ClosedLoopFilm> film = {};
};

/// The number of points of a scene's survival curve.
std::size_t points_of(const ClosedLoopScene& scene);

/// The content of an experiment file: runs, estimators, sensor noise, scoring and studies.
struct Experiment {
  std::string name;
  std::uint64_t seed = 1;
  std::vector<std::string> simulators = {"mujoco", "bullet"};
  std::vector<std::string> estimators = {"robust"};
  /// Estimators of the caller, which `estimators` may name, too. They are no part of the file.
  std::vector<EstimatorEntry> external_estimators = {};
  std::map<std::string, HyperparameterValues> hyperparameters =
      {};          ///< of these estimators, instead of the defaults
  RunsConfig fit;  ///< noiseless runs for fitting models
  /// If not empty: phase models are fitted to these instead, other learned models to both.
  std::vector<TrainingSegments> training_segments;
  std::optional<std::uint64_t> fit_seed;  ///< for drawing fitted runs, if not `seed`
  std::optional<TuningConfig> tuning;     ///< of hyperparameters on fitted runs
  RunsConfig test;                        ///< runs for scoring; no model is fitted to them
  std::string robot;                ///< file of the robot in all runs; empty: each scenario's own
  std::string sensors;              ///< file of the sensor profile; empty: ideal sensors
  std::vector<SensorFactor> sweep;  ///< of the sensors, one at a time
  noise::NoiseGridConfig noise;
  std::vector<noise::NoiseCell> highlights;  ///< cells of the grid that are scored in full
  scoring::LabelConfig labels;
  scoring::ScoringConfig scoring;
  scoring::IntervalConfig intervals;
  VideoConfig video;
  KeptRecordings recordings = KeptRecordings::pictured;
  /// Drawn if the file has the section, unless it has `enabled: false`. An empty section uses the
  /// defaults.
  std::optional<DetailConfig> detail;
  std::optional<PosteriorConfig> posterior;  ///< likewise
  std::optional<CrossSimulatorConfig> cross_simulator;
  std::optional<BenchmarkConfig> benchmark;
  std::optional<OdometryStudyConfig> odometry;
  std::optional<OperatingPointsConfig> operating_points;
  std::optional<ClosedLoopConfig> closed_loop;
  bool moments = false;       ///< adds tables of torques next to the real robot's (docs/realism.md)
  bool paper_tables = false;  ///< prints the paper's Tables I to III for every highlighted cell
  int workers = 0;            ///< threads; 0: one per core. Never changes a result.
};

/// The first number of fitted runs. Test runs are numbered from 0, so the two share no random
/// draws.
inline constexpr std::int64_t first_fit_run = 1'000'000;

/// The files that an experiment names: scenarios of all its runs; robots of its test scenarios, ""
/// for each scenario's own; sensor profiles, the experiment's own first.
std::vector<std::string> scenario_files(const Experiment& experiment);
std::vector<std::string> robot_files(const Experiment& experiment);
std::vector<std::string> sensor_files(const Experiment& experiment);

/// Reads an experiment strictly, which may name these external estimators beside the built-in ones.
/// It checks the names of engines and estimators, but not the scenario files. Errors: `InputError`
/// with file:line:column; also for an external estimator with the name of a built-in one.
Experiment experiment_from_yaml(const YamlDocument& document,
                                std::vector<EstimatorEntry> external_estimators = {});

/// The keys of an experiment file.
std::vector<Key> experiment_keys();

/// Checks that the files of an experiment exist. Errors: `InputError` with the file:line:column of
/// the first missing one, and the nearest existing file.
void require_files(const YamlDocument& document);

/// The experiment as YAML with all defaults, which reads back to the same experiment. It omits
/// `workers`, which changes no result, and the external estimators.
std::string to_yaml(const Experiment& experiment);

}  // namespace touchdown::experiments
