#include "estimator/contact_estimator.hpp"

#include <bit>

namespace touchdown {

namespace {

/// Up to rounding. Written so that NaN fails.
bool is_probability(double p) noexcept {
  constexpr double rounding = 1e-9;
  return p >= -rounding && p <= 1.0 + rounding;
}

bool is_belief(const Belief& belief) noexcept {
  return is_probability(belief.wheel[0].p_contact) && is_probability(belief.wheel[1].p_contact) &&
         is_probability(belief.p_any_wheel) && is_probability(belief.p_both_wheels);
}

}  // namespace

const Belief& ContactEstimator::update(const Signals& signals) noexcept {
  const SignalIndex unusable = check_.first_unusable(signals);
  const std::uint32_t stopped = unusable == SignalIndex::none
                                    ? stopped_.update(signals)
                                    : stopped_.update(check_.without_unusable(signals));
  if (unusable == SignalIndex::none && stopped == 0) {
    const Belief& belief = estimate(signals);
    return is_belief(belief) ? belief : reported(belief, unusable);
  }
  const Belief& belief = reported(estimate(check_.without_unusable(signals, stopped)), unusable);
  const int first = std::countr_zero(stopped);
  if (stopped == 0 || (unusable != SignalIndex::none && first > static_cast<int>(unusable))) {
    return belief;
  }
  reported_.unusable = static_cast<SignalIndex>(first);
  if (reported_.status == SignalStatus::invalid) reported_.status = SignalStatus::frozen;
  return belief;
}

const Belief& ContactEstimator::reported(const Belief& belief, SignalIndex unusable) noexcept {
  reported_ = belief;
  if (!is_belief(belief)) {
    reset();
    reported_ = Belief{};
    reported_.status = SignalStatus::invalid;
  }
  reported_.unusable = unusable;
  return reported_;
}

}  // namespace touchdown
