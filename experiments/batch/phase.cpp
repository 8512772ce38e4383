#include "experiments/batch/phase.hpp"

#include <algorithm>
#include <utility>

namespace touchdown::experiments {

namespace {

/// Log likelihoods of the torques of both legs, by phase.
PhaseRow of_both_legs(const PhaseRow& left, const PhaseRow& right) noexcept {
  PhaseRow row;
  for (std::size_t k = 0; k < phase_count; ++k) row[k] = left[k] + right[k];
  row[index(Phase::left_only)] = left[supporting_leg] + right[airborne_leg];
  row[index(Phase::right_only)] = left[airborne_leg] + right[supporting_leg];
  return row;
}

}  // namespace

BatchedPhaseFilter::BatchedPhaseFilter(std::shared_ptr<const PhaseModel> model,
                                       const PhaseFilterConfig& config,
                                       std::span<const BatchNoise> levels)
    : config_(config),
      prepared_(std::move(model), config),
      torque_(levels, torque_part),
      acceleration_(levels, &BatchNoise::acceleration),
      knee_noise_(prepared_.knee_noise, config.noise_warm_up * config.sample_rate,
                  torque_.level.size()),
      wheel_noise_(prepared_.wheel_noise, config.noise_warm_up * config.sample_rate,
                   torque_.level.size()) {
  for (const BatchNoise& level : torque_.level) {
    torque_levels_.push_back({level.knee_torque, level.wheel_torque});
  }
  for (auto* torque : {&knee_, &wheel_}) {
    torque->fill(std::vector<double>(torque_levels_.size(), 0.0));
  }
  for (const double sigma : acceleration_.level) {
    acceleration_levels_.push_back({sigma, prepared_.acceleration_noise});
  }
  Block prior{};
  for (std::size_t k = 0; k < phase_count; ++k) prior[k].fill(PhaseRecursion::prior[k]);
  alpha_.assign((levels.size() + block_size - 1) / block_size, prior);
  p_contact_.fill(std::vector(levels.size(), 0.5));
  contact_.fill(std::vector(levels.size(), 1.0));
}

void BatchedPhaseFilter::update(const Signals& clean, const NoiseStep& draws) noexcept {
  for (std::size_t side = 0; side < 2; ++side) {
    const LegSignals& leg = clean.leg[side];
    for (std::size_t i = 0; i < torque_levels_.size(); ++i) {
      const TorqueLevel& level = torque_levels_[i];
      knee_[side][i] = leg.knee.torque + level.knee_sigma * draws.torque[side].knee;
      wheel_[side][i] = leg.wheel.torque + level.wheel_sigma * draws.torque[side].wheel;
    }
  }
  if (!config_.noise) {
    knee_noise_.update(knee_);
    wheel_noise_.update(wheel_);
  }
  for (std::size_t i = 0; i < torque_levels_.size(); ++i) {
    const PhaseNoiseLevel& knee_level =
        prepared_.knee_levels[config_.noise ? 0 : knee_noise_.level(i)];
    const PhaseNoiseLevel& wheel_level =
        prepared_.wheel_levels[config_.noise ? 0 : wheel_noise_.level(i)];
    torque_levels_[i].row =
        of_both_legs(prepared_.torque(knee_[0][i], wheel_[0][i], knee_level, wheel_level),
                     prepared_.torque(-knee_[1][i], -wheel_[1][i], knee_level, wheel_level));
  }
  for (AccelerationLevel& level : acceleration_levels_) {
    const double acceleration = clean.vertical_acceleration + level.sigma * draws.acceleration;
    if (!config_.noise) level.noise.update({acceleration});
    level.row = prepared_.acceleration(
        acceleration, prepared_.acceleration_levels[config_.noise ? 0 : level.noise.level()]);
    const float single = level.row[acceleration_density_count - 1];
    level.row[index(Phase::left_only)] = level.row[index(Phase::right_only)] = single;
  }
  const std::size_t count = size();
  for (std::size_t block = 0; block < alpha_.size(); ++block) {
    Block log_likelihood;
    for (std::size_t f = 0; f < block_size; ++f) {
      const std::size_t i = std::min(block * block_size + f, count - 1);
      const PhaseRow& torque = torque_levels_[torque_.level_index[i]].row;
      const PhaseRow& vertical = acceleration_levels_[acceleration_.level_index[i]].row;
      for (std::size_t k = 0; k < phase_count; ++k) {
        log_likelihood[k][f] = static_cast<double>(torque[k] + vertical[k]);
      }
    }
    prepared_.recursion.predict_and_correct(alpha_[block], log_likelihood);
    decide(block);
  }
}

/// Probabilities and decisions of the elements of one block.
void BatchedPhaseFilter::decide(std::size_t block) noexcept {
  const Block& alpha = alpha_[block];
  const std::size_t first = block * block_size;
  const std::size_t end = std::min(first + block_size, size());
  const std::array<std::size_t, 2> other_only = {index(Phase::right_only), index(Phase::left_only)};
  for (std::size_t i = first; i < end; ++i) {
    const std::size_t f = i - first;
    const double none = alpha[index(Phase::flight)][f] + alpha[index(Phase::held)][f];
    for (std::size_t side = 0; side < 2; ++side) {
      const double p = std::clamp(1.0 - (none + alpha[other_only[side]][f]), 0.0, 1.0);
      p_contact_[side][i] = p;
      const bool was = contact_[side][i] > 0.5;
      contact_[side][i] = (was ? p >= config_.leave_below : p > config_.return_above) ? 1.0 : 0.0;
    }
  }
}

}  // namespace touchdown::experiments
