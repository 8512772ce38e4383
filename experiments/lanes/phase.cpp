#include "experiments/lanes/phase.hpp"

#include <algorithm>

namespace touchdown::experiments {

PhaseLanes::PhaseLanes(const PhaseModel& model, const PhaseFilterConfig& config,
                       std::span<const LaneNoise> levels)
    : config_(config),
      senses_(model, config),
      torque_(levels, torque_part),
      acceleration_(levels, &LaneNoise::acceleration) {
  for (const LaneNoise& level : torque_.level) {
    torque_levels_.push_back(
        {level.knee_torque, level.wheel_torque, senses_.knee_noise, senses_.wheel_noise});
  }
  for (const double sigma : acceleration_.level) {
    acceleration_levels_.push_back({sigma, senses_.acceleration_noise});
  }
  PhaseRecursion::Lanes prior{};
  std::copy(PhaseRecursion::prior.begin(), PhaseRecursion::prior.end(), prior.begin());
  alpha_.assign(levels.size(), prior);
  p_contact_.fill(std::vector(levels.size(), 0.5));
  contact_.fill(std::vector(levels.size(), 1.0));
}

void PhaseLanes::update(const Signals& clean, const NoiseStep& draws) noexcept {
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
    const PhaseNoiseLevel& knee_rung =
        senses_.knee_levels[config_.noise ? 0 : level.knee_noise.rung()];
    const PhaseNoiseLevel& wheel_rung =
        senses_.wheel_levels[config_.noise ? 0 : level.wheel_noise.rung()];
    level.left = senses_.torque(knee[0], wheel[0], knee_rung, wheel_rung);
    level.right = senses_.torque(-knee[1], -wheel[1], knee_rung, wheel_rung);
  }
  for (AccelerationLevel& level : acceleration_levels_) {
    const double acceleration = clean.vertical_acceleration + level.sigma * draws.acceleration;
    if (!config_.noise) level.noise.update({acceleration});
    level.row = senses_.acceleration(
        acceleration, senses_.acceleration_levels[config_.noise ? 0 : level.noise.rung()]);
  }
  for (std::size_t lane = 0; lane < alpha_.size(); ++lane) {
    const TorqueLevel& torque = torque_levels_[torque_.of_lane[lane]];
    senses_.recursion.predict_and_correct(
        alpha_[lane],
        PhaseRecursion::evidence(torque.left, torque.right,
                                 acceleration_levels_[acceleration_.of_lane[lane]].row));
    const std::array<double, 2> p = PhaseRecursion::wheels(alpha_[lane]);
    for (std::size_t side = 0; side < 2; ++side) {
      p_contact_[side][lane] = p[side];
      const bool was = contact_[side][lane] > 0.5;
      const bool is = was ? p[side] >= config_.leave_below : p[side] > config_.return_above;
      contact_[side][lane] = is ? 1.0 : 0.0;
    }
  }
}

}  // namespace touchdown::experiments
