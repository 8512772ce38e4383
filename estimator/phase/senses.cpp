#include "estimator/phase/senses.hpp"

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

/// Where each of these noises lies among the densities of `tables`.
template <typename Tables>
std::vector<PhaseNoiseLevel> placed(const Tables& tables, const std::vector<double>& sigmas) {
  std::vector<PhaseNoiseLevel> levels;
  for (const double sigma : sigmas) levels.push_back(tables.place(sigma));
  return levels;
}

}  // namespace

PhaseSenses::PhaseSenses(const PhaseModel& model, const PhaseFilterConfig& config)
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
      knee_levels(placed(
          torque, config.noise ? std::vector{config.noise->knee_torque} : knee_noise.rungs())),
      wheel_levels(placed(
          torque, config.noise ? std::vector{config.noise->wheel_torque} : wheel_noise.rungs())),
      acceleration_levels(placed(acceleration, config.noise
                                                   ? std::vector{config.noise->acceleration}
                                                   : acceleration_noise.rungs())) {}

}  // namespace touchdown
