#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/yaml.hpp"
#include "experiments/config/cross_simulator.hpp"
#include "experiments/config/drop_figures.hpp"
#include "noise/grid.hpp"
#include "scoring/labels.hpp"
#include "scoring/sample_unit.hpp"
#include "scoring/transitions.hpp"

namespace touchdown::experiments {

/// Which runs to simulate: every scenario, so many times.
struct RunsConfig {
  std::vector<std::string> scenarios;  ///< scenario files
  int runs = 1;                        ///< of each scenario
  bool perturbed = true;               ///< drawn from the seed, or the scenario as it stands
};

/// The run that is drawn and filmed for every engine.
struct VideoConfig {
  bool enabled = true;
  int run = 0;                          ///< index of the test run
  std::vector<std::string> estimators;  ///< whose probabilities are shown; empty: the first
  double torque_noise = 0.0;            ///< N·m
  double accelerometer_noise = 0.0;     ///< m/s²
};

/// An experiment file, seen whole: what is simulated, who listens through which noise, what counts.
struct Experiment {
  std::string name;
  std::uint64_t seed = 1;
  std::vector<std::string> simulators = {"mujoco", "bullet"};
  std::vector<std::string> estimators = {"robust"};
  RunsConfig fit;  ///< noiseless runs that the measurement models are fitted to
  std::optional<std::uint64_t> fit_seed;  ///< that these are drawn with, if not `seed`
  RunsConfig test;  ///< runs that estimators are scored on; none of them is ever fitted to
  noise::NoiseGridConfig noise;
  std::vector<noise::NoiseCell> highlights;  ///< cells of the grid that are printed and marked
  scoring::LabelConfig labels;
  scoring::ScoringConfig scoring;
  scoring::IntervalConfig intervals;
  VideoConfig video;
  std::optional<DetailConfig> detail;        ///< drawn if the file has the section
  std::optional<PosteriorConfig> posterior;  ///< likewise
  std::optional<CrossSimulatorConfig> cross_simulator;
  bool phase_study = false;   ///< adds what the phase filter's study measures (docs/protocol.md)
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

}  // namespace touchdown::experiments
