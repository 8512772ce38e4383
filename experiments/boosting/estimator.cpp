#include "experiments/boosting/estimator.hpp"

#include <cmath>
#include <utility>

namespace touchdown::experiments {

BoostedTreesEstimator::BoostedTreesEstimator(BoostedTrees trees, const Config& config)
    : config_(config), trees_(std::move(trees)), window_(config.sample_rate) {
  check_trees(trees_);
  reset();
}

void BoostedTreesEstimator::reset() noexcept {
  window_.reset();
  belief_ = Belief{};
  for (WheelBelief& wheel : belief_.wheel) wheel.contact = true;
}

const Belief& BoostedTreesEstimator::estimate(const Signals& signals) noexcept {
  const SignalWindow::Step step = window_.update(signals);
  belief_.status = step.status;
  for (std::size_t side = 0; side < 2; ++side) {
    WheelBelief& wheel = belief_.wheel[side];
    if (step.is_valid) {
      const auto logit = static_cast<double>(trees_.logit(window_.features(side)));
      wheel.p_contact = 1.0 / (1.0 + std::exp(-logit));
      wheel.contact = wheel.contact ? wheel.p_contact >= config_.leave_below
                                    : wheel.p_contact > config_.return_above;
    } else {  // the last decision holds
      wheel.p_contact = window_.relaxed(wheel.p_contact, step.elapsed);
    }
  }
  multiply_wheels(belief_);
  return belief_;
}

}  // namespace touchdown::experiments
