#include "estimator/decision/filter.hpp"

#include <algorithm>
#include <cmath>

#include "estimator/numerics/exponential.hpp"

namespace touchdown {

DecisionNetwork::DecisionNetwork(const DecisionModel& model, const DecisionConfig& config)
    : config_(config), network_(model), senses_(config) {
  check_decision_model(model);
  reset();
}

void DecisionNetwork::reset() noexcept {
  senses_.reset();
  is_started_ = {};
  belief_ = Belief{};
  for (WheelBelief& wheel : belief_.wheel) wheel.contact = true;
}

const Belief& DecisionNetwork::update(const Signals& signals) noexcept {
  const DecisionSenses::Step step = senses_.update(signals);
  belief_.status = step.status;
  if (step.restart) is_started_ = {};
  std::array<float, 2> logits{};
  if (step.is_heard[0] || step.is_heard[1]) {
    senses_.arrange();
    logits = network_.logits(senses_.pair_inputs());
  }
  const double steps = config_.smoothing * senses_.torque_noise() * config_.sample_rate;
  const double gain = 1.0 / (1.0 + steps);
  for (std::size_t side = 0; side < 2; ++side) {
    WheelBelief& wheel = belief_.wheel[side];
    if (step.is_heard[side]) {
      constexpr double surest = 30.0;
      const double logit = std::clamp<double>(logits[side], -surest, surest);
      logit_[side] = is_started_[side] ? logit_[side] + gain * (logit - logit_[side]) : logit;
      is_started_[side] = true;
      wheel.p_contact = 1.0 / (1.0 + exponential(-logit_[side]));
      wheel.contact = wheel.contact ? wheel.p_contact >= config_.leave_below
                                    : wheel.p_contact > config_.return_above;
    } else {  // the last decision stands
      wheel.p_contact = senses_.relaxed(wheel.p_contact, step.elapsed);
      is_started_[side] = false;
    }
  }
  multiply_wheels(belief_);
  return belief_;
}

}  // namespace touchdown
