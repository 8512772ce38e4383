#include "estimator/force/axle_motion.hpp"

#include <cmath>

#include "estimator/low_pass.hpp"

namespace touchdown {

namespace {

/// Whether a joint can have this velocity (rad/s); NaN fails.
bool is_velocity(double velocity) noexcept {
  constexpr double largest = 1e4;
  return std::abs(velocity) <= largest;
}

}  // namespace

AxleMotion::AxleMotion(const AxleMotionConfig& config) noexcept
    : geometry_(config.geometry),
      time_step_(1.0 / config.sample_rate),
      leak_(exact_low_pass_gain(config.leak, config.sample_rate)) {}

void AxleMotion::reset() noexcept {
  torso_ = 0.0;
  velocity_ = {};
  is_measured_ = {};
}

void AxleMotion::update(const Signals& signals, double acceleration) noexcept {
  torso_ = (1.0 - leak_) * (torso_ + acceleration * time_step_);
  for (std::size_t side = 0; side < 2; ++side) {
    const LegSignals& leg = signals.leg[side];
    is_measured_[side] = std::isfinite(leg.hip.position) && std::isfinite(leg.knee.position) &&
                         is_velocity(leg.hip.velocity) && is_velocity(leg.knee.velocity);
    if (is_measured_[side]) velocity_[side] = torso_ + axle_velocity(geometry_, leg);
  }
}

}  // namespace touchdown
