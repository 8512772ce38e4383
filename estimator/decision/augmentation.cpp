#include "estimator/decision/augmentation.hpp"

#include <cmath>

#include "core/error.hpp"

namespace touchdown {

void check_augmentation_config(const AugmentationConfig& config) {
  const auto is_level = [](double value) { return std::isfinite(value) && value >= 0.0; };
  const auto is_share = [](double value) { return value >= 0.0 && value <= 1.0; };
  if (!(is_level(config.largest_torque_noise) && is_level(config.largest_acceleration_noise) &&
        is_level(config.torque_bias) && is_level(config.position_bias) &&
        is_share(config.share_without_noise) && is_share(config.share_with_bias) &&
        is_share(config.share_without_targets) && config.gain_error >= 0.0 &&
        config.gain_error < 1.0)) {
    throw InputError(
        "augmentation: levels must be finite and not negative, shares between 0 and 1, gain_error "
        "below 1");
  }
}

Augmentation::Augmentation(const AugmentationConfig& config, Draws& draws, bool with_targets)
    : draws_(draws) {
  drops_targets_ = with_targets && draws.uniform() < config.share_without_targets;
  torque_noise_ = level(config, config.largest_torque_noise);
  acceleration_noise_ = level(config, config.largest_acceleration_noise);
  scale_ = 1.0 + config.gain_error * draws.uniform(-1.0, 1.0);
  if (draws.uniform() >= config.share_with_bias) return;
  for (Bias& bias : bias_) {
    bias = {config.torque_bias * draws.normal(), config.position_bias * draws.normal()};
  }
}

Signals Augmentation::operator()(Signals signals) {
  if (drops_targets_) signals.target = {};
  const Bias* bias = bias_.data();
  for (std::size_t side = 0; side < 2; ++side) {
    LegSignals& leg = signals.leg[side];
    LegTargets& target = signals.target[side];
    const auto disturb = [&](JointSignals& joint, JointTarget& of_joint) {
      joint.torque = scale_ * joint.torque + bias->torque;
      joint.position += bias->position;
      of_joint.position += bias->position;  // servo and target have the same zero
      ++bias;
      if (torque_noise_ > 0.0) joint.torque += torque_noise_ * draws_.normal();
    };
    disturb(leg.hip, target.hip);
    disturb(leg.knee, target.knee);
    disturb(leg.wheel, target.wheel);
  }
  if (acceleration_noise_ > 0.0) {
    signals.vertical_acceleration += acceleration_noise_ * draws_.normal();
  }
  return signals;
}

/// Zero, or log-uniform over two decades.
double Augmentation::level(const AugmentationConfig& config, double largest) {
  constexpr double smallest = 0.01;
  const bool is_without_noise = draws_.uniform() < config.share_without_noise;
  const double share = std::pow(smallest, draws_.uniform());
  return is_without_noise ? 0.0 : share * largest;
}

}  // namespace touchdown
