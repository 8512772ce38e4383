#include "estimator/phase/prepared_model.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <Eigen/Core>

#include "core/error.hpp"

namespace touchdown {
namespace {

const PhaseFilterConfig& checked(const PhaseFilterConfig& config) {
  check_phase_filter_config(config);
  return config;
}

/// The number of the model's steps per step of a filter at `filter_rate` (Hz). Throws InputError
/// unless it is a whole number.
int phase_stride(double model_rate, double filter_rate) {
  const double ratio = model_rate / filter_rate;
  const double stride = std::round(ratio);
  if (!(stride >= 1.0 && std::abs(ratio - stride) < 1e-6 * stride)) {
    throw InputError("phase filter: a sample rate of " + std::to_string(filter_rate) +
                     " Hz is not the model's " + std::to_string(model_rate) +
                     " Hz divided by a whole number");
  }
  return static_cast<int>(stride);
}

/// The exponent of likelihoods at that stride. Sparser samples count more each, but never more than
/// independent samples.
double phase_exponent(double exponent, int stride) {
  return std::max(exponent, std::min(1.0, exponent * stride));
}

/// A noise estimate up to the largest noise of the densities.
template <std::size_t channels>
NoiseEstimate<channels> noise_from(double floor, double largest, const PhaseFilterConfig& config) {
  return {floor, std::max(2.0 * floor, largest), config.noise_gain,
          config.noise_warm_up * config.sample_rate};
}

/// The position of each level of an estimate, or of the known noise, among the densities' levels.
template <std::size_t channels>
std::vector<PhaseNoiseLevel> placed(const PhaseNoiseLevels& densities,
                                    const NoiseEstimate<channels>& estimate,
                                    const std::optional<PhaseNoise>& known,
                                    double PhaseNoise::*part) {
  if (known) return {densities.place((*known).*part)};
  std::vector<PhaseNoiseLevel> levels;
  for (const double sigma : estimate.levels()) levels.push_back(densities.place(sigma));
  return levels;
}

}  // namespace

PhaseRecursion::PhaseRecursion(const PhaseModel& model, int stride) {
  using Matrix = Eigen::Matrix<double, phase_count, phase_count>;
  Matrix one;
  for (std::size_t i = 0; i < phase_count; ++i) {
    for (std::size_t j = 0; j < phase_count; ++j) {
      one(static_cast<int>(i), static_cast<int>(j)) = model.transition[i][j];
    }
  }
  Matrix all = one;
  for (int k = stride; k > 1; --k) all = all * one;
  for (std::size_t i = 0; i < phase_count; ++i) {
    for (std::size_t j = 0; j < phase_count; ++j) {
      transition_[i][j] = all(static_cast<int>(i), static_cast<int>(j));
    }
  }
}

PreparedPhaseModel::PreparedPhaseModel(std::shared_ptr<const PhaseModel> shared,
                                       const PhaseFilterConfig& config)
    : model(std::move(shared)),
      recursion(*model, phase_stride(model->sample_rate, checked(config).sample_rate)),
      torque(model->torque, phase_exponent(config.torque_exponent,
                                           phase_stride(model->sample_rate, config.sample_rate))),
      acceleration(model->acceleration,
                   phase_exponent(config.acceleration_exponent,
                                  phase_stride(model->sample_rate, config.sample_rate))),
      knee_noise(
          noise_from<2>(config.noise_floor.knee_torque, model->torque.back().noise.knee, config)),
      wheel_noise(
          noise_from<2>(config.noise_floor.wheel_torque, model->torque.back().noise.wheel, config)),
      acceleration_noise(
          noise_from<1>(config.noise_floor.acceleration, model->acceleration.back().noise, config)),
      knee_levels(
          placed(torque.noise_levels(), knee_noise, config.noise, &PhaseNoise::knee_torque)),
      wheel_levels(
          placed(torque.noise_levels(), wheel_noise, config.noise, &PhaseNoise::wheel_torque)),
      acceleration_levels(placed(acceleration.noise_levels(), acceleration_noise, config.noise,
                                 &PhaseNoise::acceleration)) {}

}  // namespace touchdown
