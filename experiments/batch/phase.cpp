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

/// Probabilities and decisions of the elements of one block.
TOUCHDOWN_WIDE_VECTORS
void decide(const BatchedPhaseRecursion::Block& alpha, Phase other_wheel_only,
            const PhaseFilterConfig& config, double* p_contact, double* contact) noexcept {
  const auto& flight = alpha.value[index(Phase::flight)];
  const auto& held = alpha.value[index(Phase::held)];
  const auto& other = alpha.value[index(other_wheel_only)];
  const double leave_below = config.leave_below;
  const double return_above = config.return_above;
  for (std::size_t i = 0; i < batch_width; ++i) {
    const double p = std::clamp(1.0 - ((flight[i] + held[i]) + other[i]), 0.0, 1.0);
    const double stays = p >= leave_below ? 1.0 : 0.0;
    const double returns = p > return_above ? 1.0 : 0.0;
    p_contact[i] = p;
    contact[i] = contact[i] > 0.5 ? stays : returns;
  }
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
                   torque_.level.size()),
      torque_likelihoods_(torque_.level.size()),
      acceleration_likelihoods_(acceleration_.level.size()),
      recursion_(prepared_.recursion, torque_.level_index, acceleration_.level_index) {
  for (const BatchNoise& level : torque_.level) {
    knee_sigma_.push_back(level.knee_torque);
    wheel_sigma_.push_back(level.wheel_torque);
  }
  for (auto* torque : {&knee_, &wheel_}) {
    torque->fill(std::vector<double>(torque_.level.size(), 0.0));
  }
  for (const double sigma : acceleration_.level) {
    acceleration_levels_.push_back({sigma, prepared_.acceleration_noise});
  }
  const std::size_t padded = recursion_.blocks().size() * batch_width;
  p_contact_.fill(std::vector(padded, 0.5));
  contact_.fill(std::vector(padded, 1.0));
}

void BatchedPhaseFilter::add_torque_noise(const Signals& clean, const NoiseStep& draws) noexcept {
  for (std::size_t side = 0; side < 2; ++side) {
    const LegSignals& leg = clean.leg[side];
    add_noise(leg.knee.torque, draws.torque[side].knee, knee_sigma_, knee_[side]);
    add_noise(leg.wheel.torque, draws.torque[side].wheel, wheel_sigma_, wheel_[side]);
  }
  if (config_.noise) return;
  knee_noise_.update(knee_);
  wheel_noise_.update(wheel_);
}

void BatchedPhaseFilter::look_up_torques() noexcept {
  for (std::size_t i = 0; i < torque_.level.size(); ++i) {
    const PhaseNoiseLevel& knee_level =
        prepared_.knee_levels[config_.noise ? 0 : knee_noise_.level(i)];
    const PhaseNoiseLevel& wheel_level =
        prepared_.wheel_levels[config_.noise ? 0 : wheel_noise_.level(i)];
    torque_likelihoods_.set(
        i, of_both_legs(prepared_.torque(knee_[0][i], wheel_[0][i], knee_level, wheel_level),
                        prepared_.torque(-knee_[1][i], -wheel_[1][i], knee_level, wheel_level)));
  }
  torque_likelihoods_.update();
}

void BatchedPhaseFilter::look_up_accelerations(double clean, double draw) noexcept {
  for (std::size_t i = 0; i < acceleration_levels_.size(); ++i) {
    AccelerationLevel& level = acceleration_levels_[i];
    const double acceleration = clean + level.sigma * draw;
    if (!config_.noise) level.noise.update({acceleration});
    PhaseRow row = prepared_.acceleration(
        acceleration, prepared_.acceleration_levels[config_.noise ? 0 : level.noise.level()]);
    const float single = row[acceleration_density_count - 1];
    row[index(Phase::left_only)] = row[index(Phase::right_only)] = single;
    acceleration_likelihoods_.set(i, row);
  }
  acceleration_likelihoods_.update();
}

void BatchedPhaseFilter::update(const Signals& clean, const NoiseStep& draws) noexcept {
  add_torque_noise(clean, draws);
  look_up_torques();
  look_up_accelerations(clean.vertical_acceleration, draws.acceleration);
  recursion_.update(torque_likelihoods_, acceleration_likelihoods_);
  constexpr std::array<Phase, 2> other_wheel_only = {Phase::right_only, Phase::left_only};
  for (std::size_t block = 0; block < recursion_.blocks().size(); ++block) {
    for (std::size_t side = 0; side < 2; ++side) {
      decide(recursion_.blocks()[block], other_wheel_only[side], config_,
             p_contact_[side].data() + block * batch_width,
             contact_[side].data() + block * batch_width);
    }
  }
}

}  // namespace touchdown::experiments
