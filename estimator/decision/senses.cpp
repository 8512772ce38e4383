#include "estimator/decision/senses.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include "estimator/low_pass.hpp"

namespace touchdown {

namespace {

const DecisionConfig& checked(const DecisionConfig& config) {
  check_decision_config(config);
  return config;
}

constexpr double shortest_scale = 1e-3;  // s
constexpr double warm_up = 0.1;          // s, of the noise estimates
constexpr double noise_gain = 0.01;

}  // namespace

TimeScales::TimeScales(double sample_rate) noexcept {
  for (std::size_t i = 0; i < decision_scales; ++i) {
    gains_[i] = static_cast<float>(
        exact_low_pass_gain(std::ldexp(shortest_scale, static_cast<int>(i)), sample_rate));
  }
}

void TimeScales::update(double input) noexcept {
  const auto x = static_cast<float>(input);
  if (!is_started_) values_.fill(x);
  is_started_ = true;
  for (std::size_t i = 0; i < decision_scales; ++i) values_[i] += gains_[i] * (x - values_[i]);
}

DecisionSenses::DecisionSenses(const DecisionConfig& config)
    : config_(checked(config).guard),
      guard_(config.guard, config.sample_rate),
      listener_{LegListener(config, false), LegListener(config, true)},
      leg_{LegScales{TimeScales(config.sample_rate), TimeScales(config.sample_rate),
                     TimeScales(config.sample_rate), TimeScales(config.sample_rate)},
           LegScales{TimeScales(config.sample_rate), TimeScales(config.sample_rate),
                     TimeScales(config.sample_rate), TimeScales(config.sample_rate)}},
      acceleration_(config.sample_rate),
      roll_rate_(config.sample_rate),
      torque_noise_(0.01, 10.0, noise_gain, warm_up * config.sample_rate),
      acceleration_noise_(0.05, 30.0, noise_gain, warm_up * config.sample_rate) {}

void DecisionSenses::reset() noexcept {
  guard_.reset();
  torque_noise_.reset();
  acceleration_noise_.reset();
  restart();
}

/// What comes does not follow what was.
void DecisionSenses::restart() noexcept {
  for (std::size_t side = 0; side < 2; ++side) {
    listener_[side].reset();
    for (TimeScales& channel : leg_[side]) channel.reset();
  }
  acceleration_.reset();
  roll_rate_.reset();
  torque_noise_.forget_signals();
  acceleration_noise_.forget_signals();
}

DecisionSenses::Step DecisionSenses::update(const Signals& signals) noexcept {
  const SignalGuard::Verdict verdict = guard_.check(signals.time, signals.vertical_acceleration);
  Step step{verdict.status, verdict.elapsed, verdict.restart, {}};
  if (verdict.restart) restart();
  const double roll_rate = signals.angular_velocity.x();
  const bool is_imu_usable = verdict.acceleration_good && std::isfinite(roll_rate);
  if (!std::isfinite(roll_rate)) step.status = SignalStatus::invalid;
  for (std::size_t side = 0; side < 2; ++side) {
    const bool usable = is_usable(signals.leg[side], config_);
    if (!usable && verdict.status == SignalStatus::good) step.status = SignalStatus::invalid;
    step.is_heard[side] = usable && is_imu_usable;
  }
  if (!step.is_heard[0] && !step.is_heard[1]) return step;

  constexpr double fastest_roll = 1e4;  // rad/s
  acceleration_.update(signals.vertical_acceleration);
  roll_rate_.update(std::clamp(roll_rate, -fastest_roll, fastest_roll));
  const auto noisy = [&](std::size_t side) {
    return step.is_heard[side] ? signals.leg[side].knee.torque : std::nan("");
  };
  torque_noise_.update({noisy(0), noisy(1)});
  acceleration_noise_.update({signals.vertical_acceleration});
  for (std::size_t side = 0; side < 2; ++side) {
    if (!step.is_heard[side]) continue;
    const LegChannels heard =
        listener_[side].update(signals.leg[side], signals.vertical_acceleration);
    leg_[side][0].update(heard.load);
    leg_[side][1].update(heard.reaction);
    leg_[side][2].update(heard.axle_velocity);
    leg_[side][3].update(heard.axle_acceleration);
  }
  // A leg that says nothing is taken to fare like the other one.
  for (std::size_t side = 0; side < 2; ++side) {
    if (step.is_heard[side]) continue;
    leg_[side] = leg_[1 - side];
    listener_[side].reset();
  }
  return step;
}

/// Compresses every channel, y → asinh(y / bend), and hands it to the wheels.
void DecisionSenses::arrange() noexcept {
  constexpr std::size_t leg_size = decision_leg_channels * decision_scales;
  constexpr std::size_t count = 2 * leg_size + 2 * decision_scales;
  std::array<float, count> x;
  auto end = x.begin();
  const auto add = [&](const TimeScales& channel, float bend) {
    for (const float value : channel.values()) *end++ = value / bend;
  };
  for (const LegScales& leg : leg_) {
    for (std::size_t i = 0; i < decision_leg_channels; ++i) add(leg[i], leg_bends[i]);
  }
  add(acceleration_, acceleration_bend);
  add(roll_rate_, roll_rate_bend);

  Eigen::Map<Eigen::Array<float, static_cast<int>(count), 1>> all(x.data());
  const Eigen::Array<float, static_cast<int>(count), 1> size = all.abs();
  const Eigen::Array<float, static_cast<int>(count), 1> compressed =
      (size + (size.square() + 1.0F).sqrt()).log();
  for (std::size_t i = 0; i < count; ++i) {
    x[i] = std::copysign(compressed[static_cast<int>(i)], x[i]);
  }

  const auto torque_noise = static_cast<float>(std::log(torque_noise_.sigma()));
  const auto acceleration_noise = static_cast<float>(std::log(acceleration_noise_.sigma()));
  for (std::size_t side = 0; side < 2; ++side) {
    auto out = inputs_[side].begin();
    const auto hand = [&](std::size_t first, std::size_t n, float sign) {
      for (std::size_t i = first; i < first + n; ++i) *out++ = sign * x[i];
    };
    hand(side * leg_size, leg_size, 1.0F);
    hand((1 - side) * leg_size, leg_size, 1.0F);
    hand(2 * leg_size, decision_scales, 1.0F);
    hand(2 * leg_size + decision_scales, decision_scales, side == 0 ? 1.0F : -1.0F);
    *out++ = torque_noise;
    *out++ = acceleration_noise;
  }
}

}  // namespace touchdown
