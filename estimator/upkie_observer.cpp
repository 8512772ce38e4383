#include "estimator/upkie_observer.hpp"

#include <cmath>

#include "estimator/signal_guard.hpp"
#include "estimator/torque_channel.hpp"

namespace touchdown {

namespace {

/// Policies use the wheel's observer alone, without the checks of `ContactEstimator`.
bool is_velocity(double velocity) noexcept {
  return std::abs(velocity) <= SignalBounds{}.velocity;  // written so that NaN fails
}

}  // namespace

WheelContactObserver::WheelContactObserver(const WheelContactConfig& config) noexcept
    : config_(config), contact_(config.initially_in_contact) {}

void WheelContactObserver::reset() noexcept { *this = WheelContactObserver(config_); }

bool WheelContactObserver::update(double torque, double velocity, double time_step) noexcept {
  if (!is_torque(torque) || !is_velocity(velocity) || !(time_step > 0.0)) return contact_;
  if (!started_) {
    started_ = true;
    velocity_ = velocity;
    return contact_;
  }
  const double gain = low_pass_gain(config_.cutoff, time_step);
  abs_torque_ += gain * (std::abs(torque) - abs_torque_);
  abs_acceleration_ += gain * (std::abs(velocity - velocity_) / time_step - abs_acceleration_);
  velocity_ = velocity;

  constexpr double at_rest = 1e-9;
  if (abs_acceleration_ < at_rest) {
    return contact_;  // a wheel at rest has no apparent inertia
  }
  inertia_ = abs_torque_ / abs_acceleration_;
  if (contact_) {
    contact_ = inertia_ >= config_.liftoff_inertia;
  } else {
    contact_ = inertia_ > config_.touchdown_inertia &&
               abs_acceleration_ > config_.minimum_touchdown_acceleration &&
               abs_torque_ > config_.minimum_touchdown_torque;
  }
  return contact_;
}

UpkieObserver::UpkieObserver(const UpkieObserverConfig& config) noexcept
    : config_(config),
      wheel_{WheelContactObserver(config.wheel), WheelContactObserver(config.wheel)} {
  apply_threshold();
}

void UpkieObserver::reset() noexcept {
  for (WheelContactObserver& wheel : wheel_) wheel.reset();
  upper_leg_torque_ = 0.0;
  belief_ = Belief{};
  apply_threshold();
}

const Belief& UpkieObserver::estimate(const Signals& signals) noexcept {
  double squares = 0.0;
  bool usable = true;
  bool upper_leg_usable = true;
  for (std::size_t side = 0; side < 2; ++side) {
    const LegSignals& leg = signals.leg[side];
    usable = usable && is_torque(leg.wheel.torque) && is_velocity(leg.wheel.velocity);
    upper_leg_usable = upper_leg_usable && is_torque(leg.hip.torque) && is_torque(leg.knee.torque);
    wheel_[side].update(leg.wheel.torque, leg.wheel.velocity, config_.time_step);
    squares += leg.hip.torque * leg.hip.torque + leg.knee.torque * leg.knee.torque;
  }
  if (upper_leg_usable) {
    const double gain = low_pass_gain(config_.upper_leg_cutoff, config_.time_step);
    upper_leg_torque_ += gain * (std::sqrt(squares) - upper_leg_torque_);
  }
  belief_.status = usable && upper_leg_usable ? SignalStatus::good : SignalStatus::invalid;
  apply_threshold();
  return belief_;
}

void UpkieObserver::apply_threshold() noexcept {
  for (std::size_t side = 0; side < 2; ++side) {
    belief_.wheel[side].contact = wheel_[side].contact();
    belief_.wheel[side].p_contact = wheel_[side].contact() ? 1.0 : 0.0;
  }
  const bool any = belief_.wheel[0].contact || belief_.wheel[1].contact;
  const bool both = belief_.wheel[0].contact && belief_.wheel[1].contact;
  belief_.p_any_wheel = any || upper_leg_torque_ > config_.upper_leg_torque_threshold ? 1.0 : 0.0;
  belief_.p_both_wheels = both ? 1.0 : 0.0;
}

}  // namespace touchdown
