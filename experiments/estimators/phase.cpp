#include "experiments/estimators/phase.hpp"

#include "experiments/lanes/phase.hpp"

namespace touchdown::experiments {

namespace {

PhaseFilterConfig config_at(const EstimatorEntry& entry, double sample_rate) {
  PhaseFilterConfig config = *entry.phase;
  config.sample_rate = sample_rate;
  return config;
}

std::optional<EstimatorLanes> lanes(const EstimatorEntry& entry, const EstimatorSetup& setup,
                                    std::span<const noise::SensorNoise> levels) {
  const auto all = std::make_shared<PhaseLanes>(
      setup.model->phase->model, config_at(entry, setup.sample_rate), lane_noise(levels));
  // Decided by two thresholds already: 0 or 1.
  return EstimatorLanes{
      [all](const Signals& clean, const NoiseStep& draws) { all->update(clean, draws); },
      [all](Side side) { return all->contact(side); }, 0.5};
}

}  // namespace

EstimatorEntry phase_entry() {
  return {.name = "phase",
          .title = "Phase filter",
          .summary = "a hidden Markov model over the phases between rolling and falling",
          .sensors = {.knee_torque = true, .wheel_torque = true, .acceleration = true},
          .phase = PhaseFilterConfig{},
          .make = [](const EstimatorEntry& entry,
                     const EstimatorSetup& setup) -> std::unique_ptr<ContactEstimator> {
            return std::make_unique<PhaseFilter>(phase_filter(entry, setup));
          },
          .lanes = lanes};
}

PhaseFilter phase_filter(const EstimatorEntry& entry, const EstimatorSetup& setup) {
  return PhaseFilter(setup.model->phase->model, config_at(entry, setup.sample_rate));
}

}  // namespace touchdown::experiments
