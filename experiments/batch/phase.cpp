#include "experiments/batch/phase.hpp"

#include <algorithm>
#include <utility>

namespace touchdown::experiments {
namespace {

constexpr int block_size = BatchedPhaseFilter::block_size;

TOUCHDOWN_WIDE_VECTORS
void predict_and_correct(const PhaseRecursion& recursion, PhaseValues<block_size>& alpha,
                         const PhaseValues<block_size>& evidence) noexcept {
  recursion.predict_and_correct(alpha, evidence);
}

}  // namespace

BatchedPhaseFilter::BatchedPhaseFilter(std::shared_ptr<const PhaseModel> model,
                                       const PhaseFilterConfig& config,
                                       std::span<const BatchNoise> levels)
    : config_(config),
      prepared_(std::move(model), config),
      torque_(torque_levels(levels)),
      sigmas_(torque_sigmas(torque_.value)),
      joint_(sigmas_.value.size(), {prepared_.knee_noise, prepared_.wheel_noise, {}, {}}),
      torque_rows_(torque_.value.size()),
      acceleration_(acceleration_levels(levels)),
      acceleration_noise_(acceleration_.value.size(), prepared_.acceleration_noise),
      acceleration_rows_(acceleration_.value.size()),
      alpha_((levels.size() + block_size - 1) / block_size) {
  for (PhaseValues<block_size>& alpha : alpha_) {
    for (std::size_t k = 0; k < phase_count; ++k) alpha[k].setConstant(PhaseRecursion::prior[k]);
  }
  p_contact_.fill(std::vector(alpha_.size() * block_size, 0.5));
  contact_.fill(std::vector(alpha_.size() * block_size, 1.0));
}

void BatchedPhaseFilter::update_torques(const Signals& clean, const NoiseStep& draws) noexcept {
  for (std::size_t i = 0; i < joint_.size(); ++i) {
    JointTorques& joint = joint_[i];
    for (std::size_t side = 0; side < 2; ++side) {
      const TorqueSample noisy =
          noisy_torque(clean.leg[side], draws.torque[side], sigmas_.value[i]);
      joint.knee[side] = noisy.knee;
      joint.wheel[side] = noisy.wheel;
    }
    if (config_.noise) continue;
    joint.knee_noise.update(joint.knee);
    joint.wheel_noise.update(joint.wheel);
  }
  for (std::size_t i = 0; i < torque_rows_.size(); ++i) {
    const JointTorques& knees = joint_[sigmas_.index[2 * i]];
    const JointTorques& wheels = joint_[sigmas_.index[2 * i + 1]];
    const PhaseNoiseLevel& knee_level = prepared_.knee_levels[knees.knee_noise.level()];
    const PhaseNoiseLevel& wheel_level = prepared_.wheel_levels[wheels.wheel_noise.level()];
    torque_rows_[i] =
        legs_row(prepared_.torque(knees.knee[0], wheels.wheel[0], knee_level, wheel_level),
                 prepared_.torque(-knees.knee[1], -wheels.wheel[1], knee_level, wheel_level));
  }
}

void BatchedPhaseFilter::update_accelerations(double clean, double draw) noexcept {
  for (std::size_t i = 0; i < acceleration_.value.size(); ++i) {
    const double acceleration = clean + acceleration_.value[i] * draw;
    NoiseEstimate<1>& noise = acceleration_noise_[i];
    if (!config_.noise) noise.update({acceleration});
    acceleration_rows_[i] =
        prepared_.acceleration(acceleration, prepared_.acceleration_levels[noise.level()]);
  }
}

/// The recursions and decisions of a block's elements. The last block repeats the last element.
void BatchedPhaseFilter::update_block(std::size_t block) noexcept {
  const auto element = [block](int f) { return block * block_size + static_cast<std::size_t>(f); };
  PhaseValues<block_size> log_likelihood;
  for (int f = 0; f < block_size; ++f) {
    const std::size_t i = std::min(element(f), torque_.index.size() - 1);
    const PhaseRow& torque = torque_rows_[torque_.index[i]];
    const PhaseRow& acceleration = acceleration_rows_[acceleration_.index[i]];
    for (std::size_t k = 0; k < phase_count; ++k) {
      log_likelihood[k][f] = static_cast<double>(torque[k] + acceleration[k]);
    }
  }
  predict_and_correct(prepared_.recursion, alpha_[block], log_likelihood);
  for (int f = 0; f < block_size; ++f) {
    const std::array<double, 2> p = wheel_probabilities(alpha_[block], f);
    for (std::size_t side = 0; side < 2; ++side) {
      double& contact = contact_[side][element(f)];
      p_contact_[side][element(f)] = p[side];
      contact = stays_or_returns(contact > 0.5, p[side], config_) ? 1.0 : 0.0;
    }
  }
}

void BatchedPhaseFilter::update(const Signals& clean, const NoiseStep& draws) noexcept {
  update_torques(clean, draws);
  update_accelerations(clean.vertical_acceleration, draws.acceleration);
  for (std::size_t block = 0; block < alpha_.size(); ++block) update_block(block);
}

}  // namespace touchdown::experiments
