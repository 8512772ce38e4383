#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/yaml.hpp"
#include "experiments/estimators/fitted_model.hpp"
#include "noise/grid.hpp"
#include "scoring/bootstrap.hpp"
#include "scoring/labels.hpp"
#include "scoring/operating_point.hpp"
#include "scoring/transitions.hpp"

namespace touchdown::experiments {

/// Which runs to simulate: every scenario, so many times.
struct RunsConfig {
  std::vector<std::string> scenarios;  ///< scenario files
  int runs = 1;                        ///< of each scenario
  bool perturbed = true;               ///< drawn from the seed, or the scenario as it stands
};

/// Pieces of fitted runs of one scene: perturbed ones, played at the control period of the test
/// runs.
struct TrainingSegments {
  std::string scenario;  ///< scenario file
  int runs = 1;
  double after = 0.3;   ///< a piece begins no earlier than this (s)
  double length = 5.0;  ///< s, less where the run ends before
  /// Pieces begin so many places apart, run by run in turn, the last one so that it ends with the
  /// run.
  int offsets = 1;
};

/// The section `fit.tuning`: every estimator that has something to choose gets as many trials,
/// which runs to fit to alone decide (docs/benchmark.md).
struct TuningConfig {
  int trials = 8;  ///< the first one an estimator's defaults
  int folds = 2;   ///< that the fitted runs are cut into: each is judged by fits to the others
  std::vector<noise::NoiseCell> noise = {{}};  ///< in which they are, on top of what sensors do
  /// Whether a benchmark's other robots and sensors have trials of their own, or else the constants
  /// that were chosen for its own.
  bool everywhere = false;
};

/// Which recordings stay in the run directory. What has none is simulated again, to the bit, where
/// it is needed.
enum class KeptRecordings : int {
  all,
  pictured,  ///< those that films and drawn drops show
  none
};

/// The run that is drawn and filmed for every engine.
struct VideoConfig {
  bool enabled = true;
  int run = 0;                          ///< index of the test run
  std::vector<std::string> estimators;  ///< whose probabilities are shown; empty: the first
  double torque_noise = 0.0;            ///< N·m
  double accelerometer_noise = 0.0;     ///< m/s²
};

/// Whose flights count as drops: those of both wheels at once, or of one whatever the other does.
enum class DropWheels : int { both, left, right };

/// One drop of one test run, or any moment of it, and how much of the time around it is shown.
/// Drops are counted from 0, as `drops` finds them.
struct DropChoice {
  int run = 0;
  DropWheels wheels = DropWheels::both;
  int drop = 0;
  std::optional<double> at = {};  ///< s since the run's start; then no drop is looked for
  int seed = 0;          ///< of the noise: the realisation that the study hears under this number
  double before = 0.15;  ///< shown before takeoff, or that moment (s)
  double after = 0.45;   ///< and after it (s)
};

/// The section `detail`: what estimators hear and conclude through one drop, drawn for every
/// engine.
struct DetailConfig {
  DropChoice choice = {};
  std::vector<noise::NoiseCell> noise = {{0.25, 1.0}, {1.0, 5.0}};  ///< one column of panels each
  std::vector<std::string> estimators = {};  ///< whose probabilities are shown
};

/// The section `posterior`: the phase filter's probability of every phase through one drop, drawn
/// for every engine.
struct PosteriorConfig {
  DropChoice choice = {};
  noise::NoiseCell noise = {1.0, 5.0};
};

/// One thing that is varied while all others stay as they are.
struct Factor {
  std::string name;
  std::string key;                      ///< of the scenario, dotted: `terrain.friction`
  std::vector<double> values;           ///< in the key's own unit
  std::vector<std::string> simulators;  ///< where it means something; empty: everywhere
};

/// What an estimator must do for its verdict.
struct VerdictConfig {
  /// Fitted in the other engine it may lose less than this of its success rate (upper end of the
  /// paired interval).
  double largest_loss = 0.01;
  /// Fitted in the other engine it must still beat always contact by more than this (lower end).
  double smallest_gain = 0.0;
  std::vector<std::string> demanded;  ///< estimators whose verdict must hold, or the run fails
};

/// The drop that is drawn in both engines.
struct OverlayConfig {
  int run = 0;   ///< index of the test run
  int drop = 3;  ///< of that run, from 0
};

/// The section `cross_simulator` of an experiment that asks how much its results depend on the
/// engine.
struct CrossSimulatorConfig {
  std::vector<Factor> factors;
  int sensitivity_runs = 4;  ///< test runs per engine and value of a factor, if so many
  VerdictConfig verdict;
  OverlayConfig overlay;
};

/// A disturbance of the sensors that is varied while all others stay as they are.
struct SensorFactor {
  std::string key;             ///< as `noise::with_value` knows it
  std::vector<double> values;  ///< in its own unit
};

/// The section `benchmark`: robots and sensors besides the experiment's own. Every estimator is
/// fitted to, and tested on, each of their combinations, and every scene is scored by itself.
struct BenchmarkConfig {
  std::vector<std::string> robots;   ///< files
  std::vector<std::string> sensors;  ///< likewise
  /// Estimators that were fitted on another robot, other sensors or in the other engine are scored
  /// beside those at home.
  bool transfer = false;
  /// Every fit is repeated so often, each time to as many runs drawn from the fitted ones with
  /// replacement: then intervals know how much depends on which runs were fitted …
  int refits = 0;
  /// … of the experiment's own robot and sensors alone, or of all.
  bool refits_everywhere = false;
  /// The worst moment of every estimator is filmed, on the experiment's own robot.
  bool clips = false;
};

/// The section `odometry`: every test run is heard by odometry that is told about contact by every
/// estimator, by the truth, and by the truth so late (docs/odometry.md).
struct OdometryStudyConfig {
  std::vector<double> delay;  ///< s
};

/// The section `operating_points`: what every estimator is worth where its decision is made by
/// these thresholds instead of its own, each of one list with each of the other that is no lower
/// (docs/metrics.md).
struct OperatingPointsConfig {
  std::vector<double> leave_below = {0.02, 0.05, 0.1, 0.15, 0.25, 0.4, 0.5, 0.6, 0.75, 0.85, 0.95};
  std::vector<double> return_above = {0.25, 0.5, 0.75, 0.9, 0.98};
};

/// Its pairs of thresholds.
std::vector<scoring::Hysteresis> points_of(const OperatingPointsConfig& config);

/// A scene in which beliefs steer, with at most one thing that is varied: a number of the scenario,
/// the noise of the sensors, or how late the law is told.
struct ClosedLoopScene {
  std::string scenario;  ///< scenario file
  std::string key = {};  ///< of the scenario, dotted: `terrain.pieces.1.stairs.rise`; empty: none
  std::vector<double> values;                  ///< in the key's own unit
  std::vector<noise::NoiseCell> noise = {{}};  ///< on top of what the sensors do
  std::vector<double> delay = {0.0};            ///< s
};

/// The run that is filmed with all who tell it beside each other.
struct ClosedLoopFilm {
  int scene = 0;                     ///< which of the scenes, from 0
  int point = 0;                     ///< which of what is varied there, from 0
  int run = 0;                       ///< index of the run
  std::string law;                   ///< one of the section's
  std::vector<std::string> contact;  ///< one to four of those who tell
};

/// The section `closed_loop`: what becomes of the robot when its policy is told about contact by an
/// estimator, by the truth or by nobody (docs/closed_loop.md).
struct ClosedLoopConfig {
  std::vector<std::string> laws = {"soft_landing"};  ///< of policies
  std::vector<std::string> contact;  ///< `truth`, `always`, estimators of the experiment
  std::vector<ClosedLoopScene> scenes;
  int runs = 8;  ///< of every scene and value, started alike whoever tells
  std::optional<ClosedLoopFilm> film = {};
};

/// How many points a scene's survival curve has.
std::size_t points_of(const ClosedLoopScene& scene);

/// An experiment file, seen whole: what is simulated, who listens through which noise, what counts.
struct Experiment {
  std::string name;
  std::uint64_t seed = 1;
  std::vector<std::string> simulators = {"mujoco", "bullet"};
  std::vector<std::string> estimators = {"robust"};
  std::map<std::string, HyperparameterValues> hyperparameters = {};  ///< of these, instead of their defaults
  RunsConfig fit;  ///< noiseless runs that the measurement models are fitted to
  /// What filters with a phase model are fitted to instead, if anything is named.
  std::vector<TrainingSegments> training_segments;
  std::optional<std::uint64_t> fit_seed;  ///< that these are drawn with, if not `seed`
  std::optional<TuningConfig> tuning;     ///< of estimators' constants on these runs
  RunsConfig test;      ///< runs that estimators are scored on; none of them is ever fitted to
  std::string robot;    ///< file of the robot in all of them; empty: each scenario's own
  std::string sensors;  ///< file of the sensors' profile; empty: ideal ones
  std::vector<SensorFactor> sweep;  ///< of these, one at a time
  noise::NoiseGridConfig noise;
  std::vector<noise::NoiseCell> highlights;  ///< cells of the grid that are printed and marked
  scoring::LabelConfig labels;
  scoring::ScoringConfig scoring;
  scoring::IntervalConfig intervals;
  VideoConfig video;
  KeptRecordings recordings = KeptRecordings::pictured;
  std::optional<DetailConfig> detail;        ///< drawn if the file has the section, unless it says
                                             ///< `enabled: false`; an empty one means its defaults
  std::optional<PosteriorConfig> posterior;  ///< likewise
  std::optional<CrossSimulatorConfig> cross_simulator;
  std::optional<BenchmarkConfig> benchmark;
  std::optional<OdometryStudyConfig> odometry;
  std::optional<OperatingPointsConfig> operating_points;
  std::optional<ClosedLoopConfig> closed_loop;
  bool moments = false;       ///< adds tables of torques beside the real robot's (docs/realism.md)
  bool phase_study = false;   ///< adds what the phase filter's study measures (docs/protocol.md)
  bool paper_tables = false;  ///< print the paper's Tables I to III for every highlighted cell
  int workers = 0;            ///< threads; 0: one per core. Never changes a result.
};

/// Test runs are numbered from 0, fitted ones from here, so that the two never share a draw.
inline constexpr std::int64_t first_fit_run = 1'000'000;

/// Reads an experiment strictly. Errors: `InputError` with file:line:column; names of engines and
/// estimators are checked here, scenario files when they are loaded.
Experiment experiment_from_yaml(const YamlDocument& document);

/// Complains about the first file of an experiment that is not there, at the place that names it.
/// Errors: `InputError` with file:line:column and the nearest existing file.
void require_files(const YamlDocument& document);

/// The experiment with every default written out, as YAML that reads back to the same experiment.
/// Leaves out `workers`: it changes no result.
std::string to_yaml(const Experiment& experiment);

}  // namespace touchdown::experiments
