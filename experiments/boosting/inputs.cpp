#include "experiments/boosting/inputs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "estimator/force/servo_law.hpp"

namespace touchdown::experiments {

ChannelInputs::ChannelInputs(const TreeInputsConfig& config)
    : extractor_(DecisionConfig{.sample_rate = config.sample_rate,
                                .geometry = config.legs,
                                .servo_load = config.servo_load}) {}

TreeInputsStep ChannelInputs::update(const Signals& signals) noexcept {
  const FeatureExtractor::Step step = extractor_.update(signals);
  if (step.is_valid[0] || step.is_valid[1]) extractor_.compute_inputs();
  return {step.status, step.elapsed, step.is_valid};
}

ChannelInputs::Features ChannelInputs::features(std::size_t side) const noexcept {
  Features features;
  const DecisionInputs inputs = extractor_.inputs(side);
  const ServoLoadInputs servo = extractor_.servo_load(side);
  std::copy(servo.begin(), servo.end(), std::copy(inputs.begin(), inputs.end(), features.begin()));
  return features;
}

ChannelWindow::ChannelWindow(double sample_rate) {
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    steps_[i] =
        static_cast<std::size_t>(std::max(1.0, std::round(window_lengths[i] * sample_rate)));
  }
  values_.resize(steps_.back());
}

void ChannelWindow::update(double value) noexcept {
  if (!is_started_) {
    zero_ = value;
    sums_ = {};
    std::fill(values_.begin(), values_.end(), 0.0);
    is_started_ = true;
  }
  last_ = value;
  const double now = value - zero_;
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const double leaving = values_[(next_ + values_.size() - steps_[i]) % values_.size()];
    sums_[i].values += now - leaving;
    sums_[i].squares += now * now - leaving * leaving;
  }
  values_[next_] = now;
  next_ = (next_ + 1) % values_.size();
}

ChannelWindow::Features ChannelWindow::features() const noexcept {
  Features features{};
  auto* feature = features.data();
  *feature++ = static_cast<float>(last_);
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    *feature++ = static_cast<float>(zero_ + sums_[i].values / static_cast<double>(steps_[i]));
  }
  for (const std::size_t i : window_deviations) {
    const auto count = static_cast<double>(steps_[i]);
    const double mean = sums_[i].values / count;
    *feature++ =
        static_cast<float>(std::sqrt(std::max(0.0, sums_[i].squares / count - mean * mean)));
  }
  return features;
}

SignalWindow::SignalWindow(const TreeInputsConfig& inputs, const SignalGuardConfig& config)
    : config_(config),
      uses_targets_(inputs.servo_load),
      guard_(config, inputs.sample_rate),
      channels_(window_channels, ChannelWindow(inputs.sample_rate)) {
  reset();
}

void SignalWindow::reset() noexcept {
  guard_.reset();
  for (ChannelWindow& channel : channels_) channel.reset();
  missing_for_.fill(std::numeric_limits<double>::infinity());
}

std::array<double, window_channels> SignalWindow::values_of(const Signals& signals,
                                                            bool has_acceleration) const noexcept {
  constexpr double missing = std::numeric_limits<double>::quiet_NaN();
  std::array<double, window_channels> values{};
  auto* to = values.data();
  const auto torque = [&](double value) { *to++ = is_torque(value, config_) ? value : missing; };
  const auto by_servo = [&](const JointSignals& joint, const JointTarget& target) {
    const double value = uses_targets_ ? servo_torque(joint, target, config_) : missing;
    *to++ = std::isfinite(value) ? value : 0.0;
  };
  for (std::size_t side = 0; side < 2; ++side) {
    const LegSignals& leg = signals.leg[side];
    for (const JointSignals* joint : {&leg.hip, &leg.knee, &leg.wheel}) torque(joint->torque);
    for (const JointSignals* joint : {&leg.hip, &leg.knee}) *to++ = joint->position;
    for (const JointSignals* joint : {&leg.hip, &leg.knee, &leg.wheel}) *to++ = joint->velocity;
    by_servo(leg.hip, signals.target[side].hip);
    by_servo(leg.knee, signals.target[side].knee);
  }
  *to++ = has_acceleration ? signals.vertical_acceleration : missing;
  for (int axis = 0; axis < 3; ++axis) *to++ = signals.angular_velocity[axis];
  return values;
}

TreeInputsStep SignalWindow::update(const Signals& signals) noexcept {
  const SignalGuard::Verdict verdict = guard_.check(signals.time, signals.vertical_acceleration);
  TreeInputsStep step{.status = verdict.status, .elapsed = verdict.elapsed, .is_valid = {}};
  if (verdict.restart) {
    for (ChannelWindow& channel : channels_) channel.reset();
    missing_for_.fill(std::numeric_limits<double>::infinity());
  }
  const std::array<double, window_channels> values = values_of(signals, verdict.acceleration_good);
  bool is_valid = true;
  for (std::size_t i = 0; i < window_channels; ++i) {
    if (std::isfinite(values[i])) {
      last_[i] = values[i];
      missing_for_[i] = 0.0;
    } else {
      missing_for_[i] += verdict.elapsed;
      if (step.status == SignalStatus::good) step.status = SignalStatus::invalid;
    }
    if (missing_for_[i] <= config_.maximum_gap) {
      channels_[i].update(last_[i]);
    } else {
      channels_[i].reset();
      is_valid = false;
    }
  }
  step.is_valid = {is_valid, is_valid};
  return step;
}

WindowFeatures SignalWindow::features(std::size_t side) const noexcept {
  WindowFeatures features{};
  auto* to = features.data();
  const auto add = [&](const ChannelWindow& channel, float sign) {
    ChannelWindow::Features own = channel.features();
    const std::size_t signed_features = own.size() - window_deviations.size();
    for (std::size_t i = 0; i < signed_features; ++i) own[i] *= sign;
    to = std::copy(own.begin(), own.end(), to);
  };
  for (const std::size_t leg : {side, 1 - side}) {
    for (std::size_t i = 0; i < window_leg_channels; ++i) {
      add(channels_[window_leg_channels * leg + i], leg == 0 ? 1.0F : -1.0F);
    }
  }
  // In the mirror, roll and yaw change their signs.
  const float mirror = side == 0 ? 1.0F : -1.0F;
  const auto* common = &channels_[2 * window_leg_channels];
  for (const float sign : {1.0F, mirror, 1.0F, mirror}) add(*common++, sign);
  return features;
}

}  // namespace touchdown::experiments
