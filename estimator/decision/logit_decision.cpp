#include "estimator/decision/logit_decision.hpp"

#include <algorithm>

#include "estimator/numerics/exponential.hpp"

namespace touchdown {

LogitDecision::LogitDecision(const DecisionConfig& config) : config_(config), features_(config) {
  reset();
}

LogitDecision::LogitDecision(DecisionConfig config, bool has_servo_load)
    : LogitDecision([&] {
        config.servo_load = has_servo_load;
        return config;
      }()) {}

void LogitDecision::reset() noexcept {
  features_.reset();
  is_started_ = {};
  decision_ = {};
  belief_ = Belief{};
  for (WheelBelief& wheel : belief_.wheel) wheel.contact = true;
}

const std::array<bool, 2>& LogitDecision::update(const Signals& signals) noexcept {
  step_ = features_.update(signals);
  belief_.status = step_.status;
  if (step_.restart) is_started_ = {};
  for (std::size_t side = 0; side < 2; ++side) belief_.wheel[side].load = features_.load(side);
  return step_.is_valid;
}

const Belief& LogitDecision::decide(const std::array<double, 2>& logit) noexcept {
  constexpr double surest = 30.0;
  const double steps = config_.smoothing * features_.torque_noise() * config_.sample_rate;
  const double gain = 1.0 / (1.0 + steps);
  for (std::size_t side = 0; side < 2; ++side) {
    WheelBelief& wheel = belief_.wheel[side];
    if (step_.is_valid[side]) {
      const double now = std::clamp(logit[side], -surest, surest);
      logit_[side] = is_started_[side] ? logit_[side] + gain * (now - logit_[side]) : now;
      is_started_[side] = true;
      wheel.p_contact = 1.0 / (1.0 + exponential(-logit_[side]));
      wheel.contact =
          decision_[side].update(wheel.contact, wheel.p_contact, step_.elapsed, config_.point);
    } else {  // the last decision stands
      wheel.p_contact = features_.relaxed(wheel.p_contact, step_.elapsed);
      is_started_[side] = false;
      decision_[side].reset();
    }
  }
  multiply_wheels(belief_);
  return belief_;
}

}  // namespace touchdown
