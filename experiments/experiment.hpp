#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/yaml.hpp"
#include "experiments/bootstrap.hpp"
#include "experiments/labels.hpp"
#include "experiments/transitions.hpp"
#include "noise/sensor_noise.hpp"

namespace touchdown {

/// Which runs to simulate: every scenario, so many times.
struct RunsConfig {
  std::vector<std::string> scenarios;  ///< scenario files
  int runs = 1;                        ///< of each scenario
  bool perturbed = true;               ///< drawn from the seed, or the scenario as it stands
};

/// Noise on knees and wheels apart, at one level of accelerometer noise; empty lists for none.
struct KneeWheelGridConfig {
  std::vector<double> knee = {};   ///< N·m
  std::vector<double> wheel = {};  ///< N·m
  double accelerometer = 0.0;      ///< on each axis (m/s²)
};

/// Standard deviations of Gaussian noise on what the estimator hears, as lists to be combined, and
/// how often each combination is drawn anew.
struct NoiseGridConfig {
  std::vector<double> torque = {0.0};         ///< on knees and wheels alike (N·m)
  std::vector<double> accelerometer = {0.0};  ///< on each axis (m/s²)
  KneeWheelGridConfig knee_wheel = {};        ///< a second grid
  double joint_position = 0.0;                ///< on every encoder, in every cell (rad)
  double joint_velocity = 0.0;                ///< on every encoder, in every cell (rad/s)
  int seeds = 1;
};

/// One noise setting of a sweep: torque noise on knees and wheels alike, or apart.
struct NoiseCell {
  double torque = 0.0;          ///< on knees and wheels (N·m); NaN where they differ
  double accelerometer = 0.0;   ///< on each axis (m/s²)
  double knee = torque;         ///< N·m
  double wheel = torque;        ///< N·m
  double joint_position = 0.0;  ///< rad; the same in every cell of an experiment
  double joint_velocity = 0.0;  ///< rad/s; likewise

  NoiseLevels levels() const {
    return {.knee_torque = knee,
            .wheel_torque = wheel,
            .acceleration = accelerometer,
            .joint_position = joint_position,
            .joint_velocity = joint_velocity};
  }

  friend bool operator==(const NoiseCell& a, const NoiseCell& b) {
    return a.knee == b.knee && a.wheel == b.wheel && a.accelerometer == b.accelerometer;
  }
};

/// A cell of a knee × wheel grid.
inline NoiseCell knee_wheel_cell(double knee, double wheel, double accelerometer) {
  const double alike = knee == wheel ? knee : std::numeric_limits<double>::quiet_NaN();
  return {alike, accelerometer, knee, wheel};
}

/// The cell with the encoder noise that belongs to every cell of the experiment.
inline NoiseCell with_encoder_noise(NoiseCell cell, const NoiseGridConfig& noise) {
  cell.joint_position = noise.joint_position;
  cell.joint_velocity = noise.joint_velocity;
  return cell;
}

/// What a bootstrap interval takes as its sample.
enum class SampleUnit : int { run, drop };

struct IntervalConfig {
  SampleUnit over = SampleUnit::run;
  BootstrapConfig bootstrap;
};

/// The run that is drawn and filmed for every engine.
struct VideoConfig {
  bool enabled = true;
  int run = 0;                          ///< index of the test run
  std::vector<std::string> estimators;  ///< whose probabilities are shown; empty: the first
  double torque_noise = 0.0;            ///< N·m
  double accelerometer_noise = 0.0;     ///< m/s²
};

/// One drop of one test run, and how much of the time around it is shown. Drops are counted from 0,
/// as `drops` finds them.
struct DropChoice {
  int run = 0;
  int drop = 0;
  int seed = 0;          ///< of the noise: the realisation that the study hears under this number
  double before = 0.15;  ///< shown before takeoff (s)
  double after = 0.45;   ///< and after it (s)
};

/// What estimators hear and conclude through one drop, drawn for every engine.
struct DetailConfig {
  DropChoice choice = {};
  std::vector<NoiseCell> noise = {{0.25, 1.0}, {1.0, 5.0}};  ///< one column of panels each
  std::vector<std::string> estimators = {};                  ///< whose probabilities are shown
};

/// The phase filter's probability of every phase through one drop, drawn for every engine.
struct PosteriorConfig {
  DropChoice choice = {};
  NoiseCell noise = {1.0, 5.0};
};

/// An experiment file, seen whole: what is simulated, who listens through which noise, what counts.
struct Experiment {
  std::string name;
  std::uint64_t seed = 1;
  std::vector<std::string> simulators = {"mujoco", "bullet"};
  std::vector<std::string> estimators = {"robust"};
  RunsConfig fit;   ///< noiseless runs that the measurement models are fitted to
  RunsConfig test;  ///< runs that estimators are scored on; none of them is ever fitted to
  NoiseGridConfig noise;
  std::vector<NoiseCell> highlights;  ///< cells of the grid that are printed and marked
  LabelConfig labels;
  ScoringConfig scoring;
  IntervalConfig intervals;
  VideoConfig video;
  std::optional<DetailConfig> detail;        ///< drawn if the file has the section
  std::optional<PosteriorConfig> posterior;  ///< likewise
  bool paper_tables = false;  ///< print the paper's Tables I to III for every highlighted cell
  int workers = 0;            ///< threads; 0: one per core. Never changes a result.
};

/// Test runs are numbered from 0, fitted ones from here, so that the two never share a draw.
inline constexpr std::int64_t first_fit_run = 1'000'000;

/// Reads an experiment strictly. Errors: `InputError` with file:line:column; names of engines and
/// estimators are checked here, scenario files when they are loaded.
Experiment experiment_from_yaml(const YamlDocument& document);

/// The experiment with every default written out, as YAML that reads back to the same experiment.
/// Leaves out `workers`: it changes no result.
std::string to_yaml(const Experiment& experiment);

}  // namespace touchdown
