#include "estimator/phase_lanes.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace touchdown {
namespace {

const PhaseModel& checked(const PhaseModel& model, const PhaseFilterConfig& config,
                          std::span<const NoiseLevel> levels) {
  check_phase_filter_config(config);
  check_phase_model(model);
  if (levels.empty()) throw InputError("a sweep needs at least one noise level");
  for (const NoiseLevel& level : levels) {
    for (const double sigma : {level.knee_torque, level.wheel_torque, level.acceleration}) {
      if (!(std::isfinite(sigma) && sigma >= 0.0)) {
        throw InputError("phase lanes: noise levels must be finite and not negative");
      }
    }
  }
  return model;
}

}  // namespace

PhaseLanes::PhaseLanes(const PhaseModel& model, const PhaseFilterConfig& config,
                       std::span<const NoiseLevel> levels)
    : config_(config),
      recursion_(checked(model, config, levels),
                 phase_stride(model.sample_rate, config.sample_rate)),
      torque_(model.torque, phase_exponent(config.torque_exponent,
                                           phase_stride(model.sample_rate, config.sample_rate))),
      acceleration_(model.acceleration,
                    phase_exponent(config.acceleration_exponent,
                                   phase_stride(model.sample_rate, config.sample_rate))) {
  const double warm_up = config.noise_warm_up * config.sample_rate;
  const NoiseEstimate<2> knee_noise(
      config.noise_floor.knee_torque,
      noise_ceiling(model.torque.back().noise.knee, config.noise_floor.knee_torque),
      config.noise_gain, warm_up);
  const NoiseEstimate<2> wheel_noise(
      config.noise_floor.wheel_torque,
      noise_ceiling(model.torque.back().noise.wheel, config.noise_floor.wheel_torque),
      config.noise_gain, warm_up);
  const NoiseEstimate<1> acceleration_noise(
      config.noise_floor.acceleration,
      noise_ceiling(model.acceleration.back().noise, config.noise_floor.acceleration),
      config.noise_gain, warm_up);
  knee_rungs_ = noise_levels(
      torque_, config.noise ? std::vector{config.noise->knee_torque} : knee_noise.rungs());
  wheel_rungs_ = noise_levels(
      torque_, config.noise ? std::vector{config.noise->wheel_torque} : wheel_noise.rungs());
  acceleration_rungs_ =
      noise_levels(acceleration_, config.noise ? std::vector{config.noise->acceleration}
                                               : acceleration_noise.rungs());
  for (const NoiseLevel& level : levels) {
    const auto torque =
        std::find_if(torque_levels_.begin(), torque_levels_.end(), [&](const TorqueLevel& other) {
          return other.knee_sigma == level.knee_torque && other.wheel_sigma == level.wheel_torque;
        });
    torque_index_.push_back(static_cast<std::uint32_t>(torque - torque_levels_.begin()));
    if (torque == torque_levels_.end()) {
      torque_levels_.push_back({level.knee_torque, level.wheel_torque, knee_noise, wheel_noise});
    }
    const auto acceleration = std::find_if(
        acceleration_levels_.begin(), acceleration_levels_.end(),
        [&](const AccelerationLevel& other) { return other.sigma == level.acceleration; });
    acceleration_index_.push_back(
        static_cast<std::uint32_t>(acceleration - acceleration_levels_.begin()));
    if (acceleration == acceleration_levels_.end()) {
      acceleration_levels_.push_back({level.acceleration, acceleration_noise});
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

void PhaseLanes::update(const Signals& clean, const NoiseDraws& draws) noexcept {
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
    const PhaseNoiseLevel& knee_rung = knee_rungs_[config_.noise ? 0 : level.knee_noise.rung()];
    const PhaseNoiseLevel& wheel_rung = wheel_rungs_[config_.noise ? 0 : level.wheel_noise.rung()];
    level.left = torque_(knee[0], wheel[0], knee_rung, wheel_rung);
    level.right = torque_(-knee[1], -wheel[1], knee_rung, wheel_rung);
  }
  for (AccelerationLevel& level : acceleration_levels_) {
    const double acceleration = clean.vertical_acceleration + level.sigma * draws.acceleration;
    if (!config_.noise) level.noise.update({acceleration});
    level.row =
        acceleration_(acceleration, acceleration_rungs_[config_.noise ? 0 : level.noise.rung()]);
  }
  for (std::size_t lane = 0; lane < alpha_.size(); ++lane) {
    const TorqueLevel& torque = torque_levels_[torque_index_[lane]];
    recursion_.predict_and_correct(
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

}  // namespace touchdown
