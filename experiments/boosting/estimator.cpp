#include "experiments/boosting/estimator.hpp"

#include <cmath>
#include <utility>

#include "experiments/boosting/channels.hpp"
#include "experiments/boosting/window.hpp"

namespace touchdown::experiments {

template <typename Inputs>
BoostedTreesEstimator<Inputs>::BoostedTreesEstimator(BoostedTrees trees, const Config& config)
    : config_(config), trees_(std::move(trees)), inputs_(config.inputs) {
  check_trees(trees_, Inputs::count);
  reset();
}

template <typename Inputs>
void BoostedTreesEstimator<Inputs>::reset() noexcept {
  inputs_.reset();
  belief_ = Belief{};
  for (WheelBelief& wheel : belief_.wheel) wheel.contact = true;
}

template <typename Inputs>
const Belief& BoostedTreesEstimator<Inputs>::estimate(const Signals& signals) noexcept {
  const TreeInputsStep step = inputs_.update(signals);
  belief_.status = step.status;
  for (std::size_t side = 0; side < 2; ++side) {
    WheelBelief& wheel = belief_.wheel[side];
    if (step.is_valid[side]) {
      const auto logit = static_cast<double>(trees_.logit(inputs_.features(side)));
      wheel.p_contact = 1.0 / (1.0 + std::exp(-logit));
      wheel.contact = wheel.contact ? wheel.p_contact >= config_.leave_below
                                    : wheel.p_contact > config_.return_above;
    } else {  // the last decision holds
      wheel.p_contact = inputs_.relaxed(wheel.p_contact, step.elapsed);
    }
  }
  multiply_wheels(belief_);
  return belief_;
}

template class BoostedTreesEstimator<SignalWindow>;
template class BoostedTreesEstimator<ChannelInputs>;

}  // namespace touchdown::experiments
