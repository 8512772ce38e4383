#include "experiments/lanes/phase.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace touchdown::experiments {
namespace {

void check(std::span<const LaneNoise> levels) {
  if (levels.empty()) throw InputError("a sweep needs at least one noise level");
  for (const LaneNoise& level : levels) {
    for (const double sigma : {level.knee_torque, level.wheel_torque, level.acceleration}) {
      if (!(std::isfinite(sigma) && sigma >= 0.0)) {
        throw InputError("phase lanes: noise levels must be finite and not negative");
      }
    }
  }
}

}  // namespace

PhaseLanes::PhaseLanes(const PhaseModel& model, const PhaseFilterConfig& config,
                       std::span<const LaneNoise> levels)
    : config_(config), senses_(model, config) {
  check(levels);
  for (const LaneNoise& level : levels) {
    const auto torque =
        std::find_if(torque_levels_.begin(), torque_levels_.end(), [&](const TorqueLevel& other) {
          return other.knee_sigma == level.knee_torque && other.wheel_sigma == level.wheel_torque;
        });
    torque_index_.push_back(static_cast<std::uint32_t>(torque - torque_levels_.begin()));
    if (torque == torque_levels_.end()) {
      torque_levels_.push_back(
          {level.knee_torque, level.wheel_torque, senses_.knee_noise, senses_.wheel_noise});
    }
    const auto acceleration = std::find_if(
        acceleration_levels_.begin(), acceleration_levels_.end(),
        [&](const AccelerationLevel& other) { return other.sigma == level.acceleration; });
    acceleration_index_.push_back(
        static_cast<std::uint32_t>(acceleration - acceleration_levels_.begin()));
    if (acceleration == acceleration_levels_.end()) {
      acceleration_levels_.push_back({level.acceleration, senses_.acceleration_noise});
    }
  }
  alpha_.resize(levels.size());
  for (std::size_t side = 0; side < 2; ++side) {
    p_contact_[side].resize(levels.size());
    contact_[side].resize(levels.size());
  }
  reset();
}

void PhaseLanes::reset() noexcept {
  for (TorqueLevel& level : torque_levels_) {
    level.knee_noise.reset();
    level.wheel_noise.reset();
  }
  for (AccelerationLevel& level : acceleration_levels_) level.noise.reset();
  PhaseRecursion::Lanes prior{};
  std::copy(PhaseRecursion::prior.begin(), PhaseRecursion::prior.end(), prior.begin());
  std::fill(alpha_.begin(), alpha_.end(), prior);
  for (std::size_t side = 0; side < 2; ++side) {
    std::fill(p_contact_[side].begin(), p_contact_[side].end(), 0.5);
    std::fill(contact_[side].begin(), contact_[side].end(), 1.0);
  }
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
    const TorqueLevel& torque = torque_levels_[torque_index_[lane]];
    senses_.recursion.predict_and_correct(
        alpha_[lane],
        PhaseRecursion::evidence(torque.left, torque.right,
                                 acceleration_levels_[acceleration_index_[lane]].row));
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
