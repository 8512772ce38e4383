#include "estimator/neural/input.hpp"

#include <cmath>

namespace touchdown {

NeuralInput neural_input(const Signals& signals) {
  NeuralInput m;
  m.segment<3>(0) = signals.linear_acceleration.cast<float>();
  m.segment<3>(3) = signals.angular_velocity.cast<float>();
  Eigen::Index at = 6;
  for (const LegSignals& leg : signals.leg) {
    m[at++] = static_cast<float>(leg.hip.position);
    m[at++] = static_cast<float>(leg.knee.position);
    m[at++] = static_cast<float>(std::sin(leg.wheel.position));
  }
  for (const LegSignals& leg : signals.leg) {
    m[at++] = static_cast<float>(leg.hip.velocity);
    m[at++] = static_cast<float>(leg.knee.velocity);
    m[at++] = static_cast<float>(leg.wheel.velocity);
  }
  m[at] = static_cast<float>(signals.ground_velocity_command);
  return m;
}

void NeuralInputSampler::reset() noexcept { *this = NeuralInputSampler(stride_); }

void NeuralInputSampler::count_step() noexcept {
  if (++steps_ < stride_) return;
  steps_ = 0;
  is_due_ = true;
}

bool NeuralInputSampler::add(const Signals& signals) noexcept {
  if (samples_ == 0) {
    command_ = signals.ground_velocity_command;
    acceleration_sum_.setZero();
  }
  count_step();
  ++samples_;
  acceleration_sum_ += signals.linear_acceleration;
  if (!is_due_) return false;
  input_ = neural_input(signals);
  input_.head<3>() = (acceleration_sum_ / samples_).cast<float>();
  input_[neural_input_count - 1] = static_cast<float>(command_);
  is_due_ = false;
  samples_ = 0;
  return true;
}

}  // namespace touchdown
