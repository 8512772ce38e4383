#pragma once

#include <cmath>
#include <cstdint>

#include "experiments/config/experiment.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/evaluation/tasks.hpp"
#include "experiments/signals/run_signals.hpp"
#include "experiments/studies/registry.hpp"
#include "noise/gaussian.hpp"

namespace touchdown::experiments {

/// A synthetic run with one flight per second, without a simulator. The right wheel lags slightly
/// behind the left one. It has two statistical segments.
inline RunSignals synthetic_run(std::int64_t number, std::size_t steps = 4000) {
  RunSignals run;
  run.info.scenario = "synthetic";
  run.info.simulator = "mujoco";
  run.info.seed = 1;
  run.info.run = number;
  run.segments = {0, steps / 2 + 100};
  const noise::NoiseKey key{.seed = 99, .run = static_cast<std::uint64_t>(number)};
  for (std::size_t k = 0; k < steps; ++k) {
    const double phase = std::fmod(0.001 * static_cast<double>(k), 1.0);
    Signals s;
    s.time = 0.001 * static_cast<double>(k);
    const bool in_flight = phase >= 0.6 && phase < 0.8;
    const double shock = phase >= 0.8 ? std::exp(-(phase - 0.8) / 0.02) : 0.0;
    const double jitter =
        0.2 * noise::standard_normal(key, noise::NoiseChannel::left_hip_position, k);
    s.vertical_acceleration =
        in_flight ? -9.81 + jitter : 60.0 * shock * std::cos(900.0 * phase) + jitter;
    s.linear_acceleration = {0.1 * jitter, 0.0, -s.vertical_acceleration};
    for (std::size_t side = 0; side < models::wheel_count; ++side) {
      const double lag = side == 0 ? 0.0 : 0.008;
      const bool air = phase >= 0.6 + lag && phase < 0.8;
      const double sign = side == 0 ? 1.0 : -1.0;
      LegSignals& leg = s.leg[side];
      leg.hip.position = sign * 0.455;
      leg.knee.position = sign * -0.791;
      leg.knee.torque = sign * (air ? 0.05 : 1.3 + 4.0 * shock) + 0.02 * jitter;
      leg.wheel.torque = sign * (air ? 0.01 : 0.3 - 0.5 * shock) + 0.01 * jitter;
      leg.wheel.position = sign * 10.0 * s.time;
      leg.wheel.velocity = sign * (10.0 + (air ? 30.0 * (phase - 0.6) : 0.0)) + 0.1 * jitter;
      run.contact[side].push_back(air ? 0 : 1);
    }
    s.up = {0.1, 0.0, -std::sqrt(0.99)};
    run.signals.push_back(s);
  }
  return run;
}

/// The estimators that only the ablation study has.
inline std::vector<EstimatorEntry> ablation_estimators() {
  return ablation_study()->section()->estimators();
}

/// The built-in estimators and those of the ablation study.
inline std::vector<EstimatorEntry> all_estimator_entries() {
  std::vector<EstimatorEntry> all(estimator_entries().begin(), estimator_entries().end());
  for (EstimatorEntry& entry : ablation_estimators()) all.push_back(std::move(entry));
  return all;
}

/// One of them.
inline const EstimatorEntry& any_estimator_entry(std::string_view name) {
  static const std::vector<EstimatorEntry> ablation = ablation_estimators();
  return estimator_entry(name, ablation);
}

/// An experiment on such runs with these estimators.
inline Experiment synthetic_experiment(const std::vector<std::string>& estimators) {
  Experiment experiment;
  experiment.name = "synthetic";
  experiment.simulators = {"mujoco"};
  experiment.estimators = estimators;
  experiment.external_estimators = ablation_estimators();
  experiment.noise.torque = {0.0, 0.5, 2.0};
  experiment.noise.accelerometer = {0.0, 3.0, 8.0};
  experiment.noise.knee_wheel = {{0.0, 1.0}, {0.0, 0.5}, 1.5};
  experiment.noise.seeds = 2;
  return experiment;
}

/// The reference for `sweep_run`: one estimator and one cell after the other.
inline std::vector<scoring::Classification> sweep_run_one_by_one(
    std::span<const Condition> conditions, std::span<const noise::NoiseCell> cells,
    const RunSignals& run, const NoiseRun& noise, const FittedModels& models,
    const Experiment& experiment, const ShouldContinue& should_continue) {
  std::vector<noise::SensorNoise> levels;
  for (const noise::NoiseCell& cell : cells) levels.push_back(cell.levels());
  std::vector<scoring::Classification> counts;
  for (const Condition& condition : conditions) {
    const auto estimator = make_estimator(experiment, condition, models, run);
    const auto by_level =
        sweep_levels(*estimator, levels, run, noise, experiment.scoring, should_continue);
    counts.insert(counts.end(), by_level.begin(), by_level.end());
  }
  return counts;
}

}  // namespace touchdown::experiments
