#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/key.hpp"
#include "core/yaml.hpp"
#include "experiments/config/study_sections.hpp"
#include "experiments/estimators/entry.hpp"
#include "experiments/figures/figure_spec.hpp"
#include "noise/sensor_noise.hpp"
#include "scoring/bootstrap.hpp"
#include "scoring/labels.hpp"
#include "scoring/transitions.hpp"

namespace touchdown::experiments {

/// The runs to simulate: each scenario `runs` times.
struct RunsConfig {
  std::vector<std::string> scenarios;  ///< scenario files
  int runs = 1;                        ///< of each scenario
  bool perturbed = true;               ///< whether perturbations are drawn from the seed
};

/// The section `fit.tuning`: every estimator with hyperparameters gets the same number of trials.
/// Only fitted runs decide which trial is best (docs/explanation/benchmark.md).
struct TuningConfig {
  int trials = 8;  ///< the first one has the estimator's defaults
  int folds = 2;   ///< of the fitted runs, for cross-validation
  std::vector<noise::NoiseCell> noise = {
      {}};  ///< noise settings of trials, in addition to the sensor model
  /// Whether a benchmark's other robots and sensors have trials of their own. Otherwise they use
  /// the values chosen for the experiment's own robot and sensors.
  bool everywhere = false;
  /// Estimators that keep their defaults.
  std::vector<std::string> fixed = {};
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
  int width = 1280;                     ///< of a run's film (px); other films are in proportion
  std::vector<std::string> estimators;  ///< with probabilities shown
  noise::NoiseCell noise;
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

/// The content of an experiment file: runs, estimators, sensor noise, scoring and studies.
struct Experiment {
  std::string name;
  std::uint64_t seed = 1;
  std::vector<std::string> simulators = {"mujoco", "bullet"};
  std::vector<std::string> estimators = {"load_filter"};
  /// Estimators of the caller and of studies' sections, which `estimators` may name, too. They are
  /// no part of the file.
  std::vector<EstimatorEntry> external_estimators = {};
  std::map<std::string, HyperparameterValues> hyperparameters =
      {};  ///< of these estimators, instead of the defaults
  /// Likewise in one engine, by engine, then estimator. They precede those of all engines.
  std::map<std::string, std::map<std::string, HyperparameterValues>> engine_hyperparameters = {};
  RunsConfig fit;                         ///< noiseless runs for fitting models
  std::optional<std::uint64_t> fit_seed;  ///< for drawing fitted runs, if not `seed`
  std::optional<TuningConfig> tuning;     ///< of hyperparameters on fitted runs
  RunsConfig test;                        ///< runs for scoring; no model is fitted to them
  std::string robot;    ///< file of the robot in all runs; empty: each scenario's own
  std::string sensors;  ///< file of the sensor profile; empty: ideal sensors
  noise::NoiseGridConfig noise;
  std::vector<noise::NoiseCell> highlights;  ///< cells of the grid that are scored in full
  scoring::LabelConfig labels;
  scoring::ScoringConfig scoring;
  scoring::IntervalConfig intervals;
  VideoConfig video;
  PrintConfig figures = {};
  KeptRecordings recordings = KeptRecordings::pictured;
  /// Drawn if the file has the section, unless it has `enabled: false`. An empty section uses the
  /// defaults.
  std::optional<DetailConfig> detail;
  StudySections studies;      ///< sections of the studies that it asks for
  bool paper_tables = false;  ///< prints the paper's Tables I to III for every highlighted cell
  int workers = 0;            ///< threads; 0: one per core. Never changes a result.
};

/// The first number of fitted runs. Test runs are numbered from 0, so the two share no random
/// draws.
inline constexpr std::int64_t first_fit_run = 1'000'000;

/// The files that an experiment names, with those of its studies' sections; robots of its test
/// scenarios, "" for each scenario's own; the experiment's own sensors first.
ExperimentFiles files_of(const Experiment& experiment);

/// The names of all estimators that the experiment can use: built-in ones, then its external ones.
std::vector<std::string> estimator_names(const Experiment& experiment);

/// The estimator of this name, built-in or one of the experiment's external ones, which live as
/// long as the experiment. Errors: `InputError` with the nearest known name.
const EstimatorEntry& estimator_entry(const Experiment& experiment, std::string_view name);

}  // namespace touchdown::experiments
