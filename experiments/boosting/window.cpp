#include "experiments/boosting/window.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace touchdown::experiments {

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

SignalWindow::SignalWindow(double sample_rate, const SignalGuardConfig& config)
    : config_(config),
      guard_(config, sample_rate),
      channels_(window_channels, ChannelWindow(sample_rate)) {
  reset();
}

void SignalWindow::reset() noexcept {
  guard_.reset();
  for (ChannelWindow& channel : channels_) channel.reset();
  missing_for_.fill(std::numeric_limits<double>::infinity());
}

SignalWindow::Step SignalWindow::update(const Signals& signals) noexcept {
  const SignalGuard::Verdict verdict = guard_.check(signals.time, signals.vertical_acceleration);
  Step step{.status = verdict.status, .elapsed = verdict.elapsed, .is_valid = true};
  if (verdict.restart) {
    for (ChannelWindow& channel : channels_) channel.reset();
    missing_for_.fill(std::numeric_limits<double>::infinity());
  }
  const LegSignals& left = signals.leg[0];
  const LegSignals& right = signals.leg[1];
  const std::array<double, window_channels> values = {left.knee.torque, left.wheel.torque,
                                                      right.knee.torque, right.wheel.torque,
                                                      signals.vertical_acceleration};
  for (std::size_t i = 0; i < window_channels; ++i) {
    const bool is_acceleration = i + 1 == window_channels;
    if (is_acceleration ? verdict.acceleration_good : is_torque(values[i], config_)) {
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
      step.is_valid = false;
    }
  }
  return step;
}

WindowFeatures SignalWindow::features(std::size_t side) const noexcept {
  constexpr std::size_t per_leg = 2;
  WindowFeatures features{};
  auto* to = features.data();
  for (const std::size_t leg : {side, 1 - side}) {
    const float mirror = leg == 0 ? 1.0F : -1.0F;
    for (std::size_t joint = 0; joint < per_leg; ++joint) {
      ChannelWindow::Features own = channels_[per_leg * leg + joint].features();
      const std::size_t signed_features = own.size() - window_deviations.size();
      for (std::size_t i = 0; i < signed_features; ++i) own[i] *= mirror;
      to = std::copy(own.begin(), own.end(), to);
    }
  }
  const ChannelWindow::Features acceleration = channels_.back().features();
  std::copy(acceleration.begin(), acceleration.end(), to);
  return features;
}

}  // namespace touchdown::experiments
