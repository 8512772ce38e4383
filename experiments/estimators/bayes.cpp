#include "experiments/estimators/bayes.hpp"

#include "estimator/bayes/filter.hpp"
#include "experiments/lanes/bayes.hpp"

namespace touchdown::experiments {

namespace {

std::optional<EstimatorLanes> lanes(const EstimatorEntry& entry, const EstimatorSetup& setup,
                                    std::span<const noise::SensorNoise> levels) {
  const auto all = std::make_shared<BayesFilterLanes>(
      *setup.model->measurement, config_at(entry, setup.sample_rate), lane_noise(levels));
  return EstimatorLanes{
      [all](const Signals& clean, const NoiseStep& draws) { all->update(clean, draws); },
      [all](Side side) { return all->p_contact(side); }, entry.config->threshold};
}

}  // namespace

EstimatorEntry bayes_entry(const std::string& name, const std::string& summary,
                           const BayesFilterConfig& config) {
  return {.name = name,
          .title = "Bayes filter (" + name + ")",
          .summary = summary,
          .sensors = {.knee_torque = true, .wheel_torque = true, .acceleration = true},
          .config = config,
          .make = [](const EstimatorEntry& entry,
                     const EstimatorSetup& setup) -> std::unique_ptr<ContactEstimator> {
            return std::make_unique<BayesFilter>(*setup.model->measurement,
                                                 config_at(entry, setup.sample_rate));
          },
          .lanes = lanes};
}

BayesFilterConfig config_at(const EstimatorEntry& entry, double sample_rate) {
  BayesFilterConfig config = *entry.config;
  config.sample_rate = sample_rate;
  return config;
}

}  // namespace touchdown::experiments
