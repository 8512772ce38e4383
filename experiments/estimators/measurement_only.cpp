#include "experiments/estimators/measurement_only.hpp"

#include "estimator/bayes/measurement_only.hpp"
#include "experiments/estimators/bayes.hpp"
#include "experiments/lanes/measurement.hpp"

namespace touchdown::experiments {

namespace {

std::optional<EstimatorLanes> lanes(const EstimatorEntry& entry, const EstimatorSetup& setup,
                                    std::span<const noise::SensorNoise> levels) {
  const auto all = std::make_shared<MeasurementLanes>(
      *setup.model->measurement, config_at(entry, setup.sample_rate), lane_noise(levels));
  return EstimatorLanes{
      [all](const Signals& clean, const NoiseStep& draws) { all->update(clean, draws); },
      [all](Side side) { return all->p_measurement(side); }, entry.config->threshold};
}

}  // namespace

EstimatorEntry measurement_only_entry() {
  return {.name = "measurement_only",
          .title = "Measurement only",
          .summary = "the paper's ablation: each wheel from its torques now, without transitions",
          .sensors = {.knee_torque = true, .wheel_torque = true},
          .config = BayesFilterConfig::robust(),
          .make = [](const EstimatorEntry& entry,
                     const EstimatorSetup& setup) -> std::unique_ptr<ContactEstimator> {
            return std::make_unique<MeasurementOnly>(*setup.model->measurement,
                                                     config_at(entry, setup.sample_rate));
          },
          .lanes = lanes};
}

}  // namespace touchdown::experiments
