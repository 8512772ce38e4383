#include "estimator/phase/prepared_model.hpp"

#include <algorithm>

namespace touchdown {
namespace {

const PhaseModel& checked(const PhaseModel& model, const PhaseFilterConfig& config) {
  check_phase_filter_config(config);
  check_phase_model(model);
  return model;
}

/// Up to the largest noise that densities were prepared for.
template <std::size_t channels>
NoiseEstimate<channels> noise_from(double floor, double largest, const PhaseFilterConfig& config) {
  return {floor, std::max(2.0 * floor, largest), config.noise_gain,
          config.noise_warm_up * config.sample_rate};
}

/// Where each rung of an estimate, or the noise if it is known, lies among prepared densities.
template <std::size_t channels>
std::vector<PhaseNoiseLevel> placed(const PhaseNoiseLevels& ladder,
                                    const NoiseEstimate<channels>& estimate,
                                    const std::optional<PhaseNoise>& known,
                                    double PhaseNoise::*part) {
  if (known) return {ladder.place((*known).*part)};
  std::vector<PhaseNoiseLevel> levels;
  for (const double sigma : estimate.rungs()) levels.push_back(ladder.place(sigma));
  return levels;
}

}  // namespace

PreparedPhaseModel::PreparedPhaseModel(const PhaseModel& model, const PhaseFilterConfig& config)
    : recursion(checked(model, config), phase_stride(model.sample_rate, config.sample_rate)),
      torque(model.torque, phase_exponent(config.torque_exponent,
                                          phase_stride(model.sample_rate, config.sample_rate))),
      acceleration(model.acceleration,
                   phase_exponent(config.acceleration_exponent,
                                  phase_stride(model.sample_rate, config.sample_rate))),
      knee_noise(
          noise_from<2>(config.noise_floor.knee_torque, model.torque.back().noise.knee, config)),
      wheel_noise(
          noise_from<2>(config.noise_floor.wheel_torque, model.torque.back().noise.wheel, config)),
      acceleration_noise(
          noise_from<1>(config.noise_floor.acceleration, model.acceleration.back().noise, config)),
      knee_levels(placed(torque.ladder(), knee_noise, config.noise, &PhaseNoise::knee_torque)),
      wheel_levels(placed(torque.ladder(), wheel_noise, config.noise, &PhaseNoise::wheel_torque)),
      acceleration_levels(placed(acceleration.ladder(), acceleration_noise, config.noise,
                                 &PhaseNoise::acceleration)) {}

}  // namespace touchdown
