#include "estimator/free_fall.hpp"

#include <cmath>

#include "core/error.hpp"
#include "estimator/low_pass.hpp"

namespace touchdown {

FreeFall::FreeFall(const FreeFallConfig& config)
    : config_(config), guard_(config.guard, config.sample_rate) {
  if (!(config.low_pass >= 0.0 && config.width > 0.0)) {
    throw InputError("free fall: width must be positive (m/s²), low_pass not negative (s)");
  }
  gain_ = exact_low_pass_gain(config.low_pass, config.sample_rate);
  reset();
}

void FreeFall::reset() noexcept {
  guard_.reset();
  acceleration_ = 0.0;
  p_contact_ = 0.5;
  belief_ = Belief{};
}

const Belief& FreeFall::estimate(const Signals& signals) noexcept {
  const SignalGuard::Verdict verdict = guard_.check(signals.time, signals.vertical_acceleration);
  if (verdict.restart) acceleration_ = 0.0;
  if (verdict.acceleration_good) {
    acceleration_ += gain_ * (signals.vertical_acceleration - acceleration_);
    p_contact_ = 1.0 / (1.0 + std::exp(-(acceleration_ - config_.half_way) / config_.width));
  } else {
    p_contact_ = guard_.relaxed(p_contact_, verdict.elapsed);
  }
  // Both wheels share one accelerometer, so they are not independent of each other.
  belief_.wheel.fill({p_contact_, p_contact_ >= 0.5});
  belief_.p_any_wheel = belief_.p_both_wheels = p_contact_;
  belief_.status = verdict.status;
  return belief_;
}

}  // namespace touchdown
