#include "experiments/estimators/neural.hpp"

#include "experiments/lanes/neural.hpp"
#include "recordings/models/neural_network.hpp"

namespace touchdown::experiments {

namespace {

std::shared_ptr<const NeuralNetwork> network() {
  return std::make_shared<const NeuralNetwork>(recordings::shipped_neural_network());
}

/// Lanes share what the encoders say, so they know no noise on them.
std::optional<EstimatorLanes> lanes(const EstimatorEntry& /*entry*/, const EstimatorSetup& setup,
                                    std::span<const noise::SensorNoise> levels) {
  std::vector<double> sigmas;
  for (const noise::SensorNoise& level : levels) {
    if (level.joint_position != 0.0 || level.joint_velocity != 0.0) return std::nullopt;
    sigmas.push_back(level.acceleration);
  }
  const NeuralEstimatorConfig config{.sample_rate = setup.sample_rate};
  const auto all = std::make_shared<NeuralLanes>(network(), config, sigmas);
  return EstimatorLanes{[all](const Signals& clean, const NoiseStep& draws) {
                          const auto& [x, y, z] = draws.linear_acceleration;
                          all->update(clean, {x, y, z});
                        },
                        [all](Side /*side*/) { return all->p_contact(); }, config.threshold};
}

}  // namespace

EstimatorEntry neural_entry() {
  return {.name = "nmn",
          .title = "NMN",
          .summary = "the paper's neural measurement network: IMU, joints and command, no torques",
          .sensors = {.acceleration = true, .joint_position = true, .joint_velocity = true},
          .trained_by = "touchdown train",
          .make = [](const EstimatorEntry& /*entry*/,
                     const EstimatorSetup& setup) -> std::unique_ptr<ContactEstimator> {
            return std::make_unique<NeuralEstimator>(
                network(), NeuralEstimatorConfig{.sample_rate = setup.sample_rate});
          },
          .lanes = lanes};
}

}  // namespace touchdown::experiments
