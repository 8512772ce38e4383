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
      gain_(exact_low_pass_gain(config.low_pass, config.sample_rate)) {}

void WheelLoads::reset() noexcept {
  guard_.reset();
  force_ = {};
  is_started_ = {};
}

WheelLoads::Step WheelLoads::update(const Signals& signals) noexcept {
  const SignalGuard::Verdict verdict = guard_.check(signals.time, signals.vertical_acceleration);
  Step step{verdict.status, verdict.elapsed, verdict.restart, verdict.acceleration_good, {}};
  if (verdict.restart) is_started_ = {};
  for (std::size_t side = 0; side < 2; ++side) {
    const LegSignals& leg = signals.leg[side];
    const bool usable = has_load(leg, config_.guard);
    if (!usable && verdict.status == SignalStatus::good) step.status = SignalStatus::invalid;
    if (!usable || !verdict.acceleration_good) continue;
    const double measured =
        vertical_force(config_.geometry, leg, side == 1, signals.vertical_acceleration);
    if (!std::isfinite(measured)) continue;
    const double force = std::clamp(measured, -config_.largest, config_.largest);
    force_[side] = is_started_[side] ? force_[side] + gain_ * (force - force_[side]) : force;
    is_started_[side] = true;
    step.is_measured[side] = true;
  }
  return step;
}

}  // namespace touchdown
