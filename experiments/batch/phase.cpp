#include "experiments/batch/phase.hpp"

#include <algorithm>

namespace touchdown::experiments {

BatchedPhaseFilter::BatchedPhaseFilter(const PhaseModel& model, const PhaseFilterConfig& config,
                                       std::span<const BatchNoise> levels)
    : config_(config),
      prepared_(model, config),
      torque_(levels, torque_part),
      acceleration_(levels, &BatchNoise::acceleration) {
  for (const BatchNoise& level : torque_.level) {
    torque_levels_.push_back(
        {level.knee_torque, level.wheel_torque, prepared_.knee_noise, prepared_.wheel_noise});
  }
  for (const double sigma : acceleration_.level) {
    acceleration_levels_.push_back({sigma, prepared_.acceleration_noise});
  }
  PhaseRecursion::Lanes prior{};
  std::copy(PhaseRecursion::prior.begin(), PhaseRecursion::prior.end(), prior.begin());
  alpha_.assign(levels.size(), prior);
  p_contact_.fill(std::vector(levels.size(), 0.5));
  contact_.fill(std::vector(levels.size(), 1.0));
}

void BatchedPhaseFilter::update(const Signals& clean, const NoiseStep& draws) noexcept {
  for (TorqueLevel& level : torque_levels_) {
    std::array<double, 2> knee{};
    std::array<double, 2> wheel{};
    for (std::size_t side = 0; side < 2; ++side) {
      const LegSignals& leg = clean.leg[side];
      knee[side] = leg.knee.torque + level.knee_sigma * draws.torque[side].knee;
      wheel[side] = leg.wheel.torque + level.wheel_sigma * draws.torque[side].wheel;
    }
    if (!config_.noise) {
      level.knee_noise.update(knee);
      level.wheel_noise.update(wheel);
    }
    const PhaseNoiseLevel& knee_level =
        prepared_.knee_levels[config_.noise ? 0 : level.knee_noise.level()];
    const PhaseNoiseLevel& wheel_level =
        prepared_.wheel_levels[config_.noise ? 0 : level.wheel_noise.level()];
    level.left = prepared_.torque(knee[0], wheel[0], knee_level, wheel_level);
    level.right = prepared_.torque(-knee[1], -wheel[1], knee_level, wheel_level);
  }
  for (AccelerationLevel& level : acceleration_levels_) {
    const double acceleration = clean.vertical_acceleration + level.sigma * draws.acceleration;
    if (!config_.noise) level.noise.update({acceleration});
    level.row = prepared_.acceleration(
        acceleration, prepared_.acceleration_levels[config_.noise ? 0 : level.noise.level()]);
  }
  for (std::size_t i = 0; i < alpha_.size(); ++i) {
    const TorqueLevel& torque = torque_levels_[torque_.level_index[i]];
    prepared_.recursion.predict_and_correct(
        alpha_[i],
        PhaseRecursion::evidence(torque.left, torque.right,
                                 acceleration_levels_[acceleration_.level_index[i]].row));
    const std::array<double, 2> p = PhaseRecursion::wheels(alpha_[i]);
    for (std::size_t side = 0; side < 2; ++side) {
      p_contact_[side][i] = p[side];
      const bool was = contact_[side][i] > 0.5;
      const bool is = was ? p[side] >= config_.leave_below : p[side] > config_.return_above;
      contact_[side][i] = is ? 1.0 : 0.0;
    }
  }
}

}  // namespace touchdown::experiments
