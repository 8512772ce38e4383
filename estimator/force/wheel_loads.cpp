#include "estimator/force/wheel_loads.hpp"

#include <algorithm>

#include "estimator/low_pass.hpp"

namespace touchdown {

bool is_sensible(const WheelLoadsConfig& config) noexcept {
  return config.low_pass >= 0.0 && config.geometry.upper_length > 0.0 &&
         config.geometry.lower_length > 0.0 && config.largest > 0.0;
}

WheelLoads::WheelLoads(const WheelLoadsConfig& config)
    : config_(config),
      guard_(config.guard, config.sample_rate),
      gain_(exact_low_pass_gain(config.low_pass, config.sample_rate)),
      torque_noise_(0.01, 10.0, 0.01, 0.1 * config.sample_rate),
      acceleration_noise_(0.05, 30.0, 0.01, 0.1 * config.sample_rate),
      load_estimates_(config.geometry, config.sample_rate) {}

void WheelLoads::reset() noexcept {
  guard_.reset();
  force_ = {};
  is_started_ = {};
  torque_noise_.reset();
  acceleration_noise_.reset();
  load_estimates_.reset();
}

WheelLoads::Step WheelLoads::update(const Signals& signals) noexcept {
  const SignalGuard::Verdict verdict = guard_.check(signals.time, signals.vertical_acceleration);
  Step step{verdict.status, verdict.elapsed, verdict.restart, verdict.acceleration_good, {}};
  if (verdict.restart) {
    is_started_ = {};
    load_estimates_.reset();
  }
  const double acceleration = signals.vertical_acceleration;
  std::array<FootJacobian, 2> feet;
  std::array<LegLoad, 2> loads;
  std::array<double, 2> knee_torque;
  for (std::size_t side = 0; side < 2; ++side) {
    const LegSignals& leg = signals.leg[side];
    const bool usable = has_load(leg, config_.guard);
    if (!usable && verdict.status == SignalStatus::good) step.status = SignalStatus::invalid;
    knee_torque[side] = usable ? leg.knee.torque : std::nan("");
    if (!usable || !verdict.acceleration_good) continue;
    const FootJacobian& foot = feet[side] = foot_jacobian(config_.geometry, leg, side == 1);
    loads[side] = {
        vertical_force_times_determinant(config_.geometry, foot, leg, side == 1, acceleration),
        servo_load(config_.geometry, foot, leg, signals.target[side], side == 1, acceleration,
                   config_.guard),
        true};
    const double measured = vertical_force(config_.geometry, leg, side == 1, acceleration);
    if (!std::isfinite(measured)) continue;
    const double force = std::clamp(measured, -config_.largest, config_.largest);
    force_[side] = is_started_[side] ? force_[side] + gain_ * (force - force_[side]) : force;
    is_started_[side] = true;
    step.is_measured[side] = true;
  }
  step.load =
      load_estimates_.update(feet, loads, {torque_noise_.sigma(), acceleration_noise_.sigma()});
  torque_noise_.update(knee_torque);
  acceleration_noise_.update({verdict.acceleration_good ? acceleration : std::nan("")});
  return step;
}

}  // namespace touchdown
