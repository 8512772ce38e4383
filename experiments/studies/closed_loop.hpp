#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "estimator/odometry/wheeled_leg.hpp"
#include "experiments/estimators/fitted_model.hpp"
#include "experiments/plan/rollouts.hpp"
#include "experiments/studies/study.hpp"
#include "logs/recording.hpp"
#include "noise/sensor_noise.hpp"
#include "scenarios/engine.hpp"
#include "scoring/labels.hpp"
#include "scoring/transitions.hpp"

namespace touchdown::experiments {

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
/// truth or without contact feedback (docs/explanation/closed_loop.md).
struct ClosedLoopConfig {
  std::vector<std::string> laws = {"soft_landing"};  ///< of policies
  std::vector<std::string> contact;  ///< contact sources: `truth`, `always`, estimators
  std::vector<ClosedLoopScene> scenes;
  int runs = 8;  ///< per scene and value, the same for all contact sources
  std::optional<ClosedLoopFilm> film = {};
};

/// One point of one survival curve. Its runs differ only in their random draws.
struct ClosedLoopCell {
  std::string simulator;
  std::string law;
  std::string contact;    ///< source of the policy: `truth`, `always`, an estimator
  std::size_t scene = 0;  ///< index in the section
  std::size_t point = 0;  ///< index in the scene
  double value = 0.0;     ///< of the scene's key; NaN without a key
  noise::NoiseCell noise = {};
  double delay = 0.0;  ///< of the contact (s)

  /// Oracles read the simulator's state: no robot has them, and nothing is ever fitted to their
  /// runs.
  bool is_oracle() const { return contact == "truth"; }
};

/// The cells of the section `closed_loop`, by scene, engine, law, contact source, then point.
std::vector<ClosedLoopCell> closed_loop_cells(const Experiment& experiment);

/// The scenario of a cell, without perturbations. Errors: `InputError` that names the scene and the
/// invalid value.
scenarios::Scenario scenario_of(const RunRequest& request, const ClosedLoopCell& cell);

/// The contact that a policy received for each wheel, step by step.
struct ContactTrace {
  std::array<scoring::ContactSequence, models::wheel_count> contact;
  std::array<std::vector<float>, models::wheel_count> p_contact;
};

struct ClosedLoopRun {
  scenarios::Scenario scenario;  ///< as simulated
  logs::Recording recording;
  ContactTrace trace;  ///< before the policy's delay
};

/// Simulates a run of a cell. Its perturbations are those of the test run with this index, for
/// every contact source. Errors: `InputError` for an invalid scene.
ClosedLoopRun run_closed_loop(const RunRequest& request, const ClosedLoopCell& cell,
                              std::int64_t run, const FittedModels& models,
                              scenarios::CompiledScenes& scenes,
                              const ShouldContinue& should_continue);

/// Closed-loop metrics, summed over runs. docs/reference/metrics.md defines each.
struct ClosedLoopMetrics {
  std::int64_t runs = 0;
  std::int64_t finished = 0;
  std::int64_t fell = 0;               ///< or diverged
  std::int64_t landings = 0;           ///< of wheels, after a flight of the minimum duration
  double squared_landing_speed = 0.0;  ///< slip speed of the tyres at landings, summed (m²/s²)
  double largest_pitch = 0.0;          ///< maximum of each run, summed (rad)
  double largest_force = 0.0;       ///< normal force on one wheel, maximum of each run, summed (N)
  std::int64_t false_takeoffs = 0;  ///< of the robot, in the recorded contact
  std::int64_t contact_us = 0;      ///< time with a wheel in contact (µs)

  double landing_speed_rms() const;          ///< m/s
  double mean_largest_pitch() const;         ///< rad
  double mean_largest_force() const;         ///< N
  double false_takeoffs_per_minute() const;  ///< per minute of contact

  ClosedLoopMetrics& operator+=(const ClosedLoopMetrics& other);
};

/// The metrics of one run. `recording` is from ideal sensors, `robot` as described by its file.
/// `trace` is the contact (left, right) at every step, before the policy's delay.
ClosedLoopMetrics closed_loop_metrics_of(
    const logs::Recording& recording,
    const std::array<scoring::ContactSequence, models::wheel_count>& trace,
    const odometry::WheeledBiped& robot, const scoring::LabelConfig& labels,
    const scoring::ScoringConfig& scoring);

/// Slip speed of each tyre's lowest point over the ground along the robot's heading (m/s), positive
/// where the wheel turns faster than it travels.
std::array<double, models::wheel_count> tyre_speeds(const models::Observation& observation,
                                                    const models::GroundTruth& truth,
                                                    const odometry::WheeledBiped& robot);

/// Simulates one run of the section, by its number, and measures it. A run that cannot be simulated
/// counts as a fall. Errors: `InputError` for an invalid scene; `Stopped`.
ClosedLoopMetrics measure_closed_loop(const RunRequest& request, std::size_t run,
                                      const FittedModels& models, scenarios::CompiledScenes& scenes,
                                      const ShouldContinue& should_continue);

/// Writes `survival.csv` and returns its text and figures. Errors: `Error` for a run that is not
/// saved.
StudyResult summarize_closed_loop(const Evaluation& evaluation, const RunDirectory& directory);

}  // namespace touchdown::experiments
