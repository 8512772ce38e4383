#include "estimator/evidence/contributions.hpp"

namespace touchdown {

namespace {

/// Channels of a leg, in the order of `DecisionInputs`.
enum LegChannel : std::size_t {
  load_channel,
  ground_torque_channel,
  axle_velocity_channel,
  axle_acceleration_channel
};

}  // namespace

Evidence::Contributions evidence_contributions(const EvidenceModel& model,
                                               const DecisionInputs& inputs,
                                               const ServoLoadInputs& servo) noexcept {
  const auto channel = [&](std::size_t number) {
    double sum = 0.0;
    for (std::size_t i = number * decision_scales; i < (number + 1) * decision_scales; ++i) {
      sum += static_cast<double>(evidence_at(model.curve[i], inputs[i]));
    }
    return sum;
  };
  const auto servo_load = [&](std::size_t leg) {
    double sum = 0.0;
    if (model.servo_curve.empty()) return sum;
    for (std::size_t i = leg * decision_scales; i < (leg + 1) * decision_scales; ++i) {
      sum += static_cast<double>(evidence_at(model.servo_curve[i], servo[i]));
    }
    return sum;
  };
  Evidence::Contributions all;
  all.load = channel(load_channel) + servo_load(0);
  all.ground_torque = channel(ground_torque_channel);
  all.axle_motion = channel(axle_velocity_channel) + channel(axle_acceleration_channel);
  all.other_leg = servo_load(1);
  for (std::size_t i = decision_leg_channels; i < 2 * decision_leg_channels; ++i) {
    all.other_leg += channel(i);
  }
  all.torso = channel(2 * decision_leg_channels) + channel(2 * decision_leg_channels + 1);
  all.offset = static_cast<double>(model.bias);
  for (std::size_t i = decision_channels * decision_scales; i < decision_inputs; ++i) {
    all.offset += static_cast<double>(evidence_at(model.curve[i], inputs[i]));
  }
  return all;
}

}  // namespace touchdown
