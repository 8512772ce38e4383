#include "experiments/boosting/estimator.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/error.hpp"

namespace touchdown::experiments {

float BoostedTrees::logit(std::span<const float> features) const noexcept {
  // A step down a tree depends on the previous one. Steps down different trees are independent.
  constexpr std::size_t abreast = 8;
  const std::size_t inner = nodes();
  const std::size_t count = trees();
  float sum = bias;
  for (std::size_t first = 0; first < count; first += abreast) {
    const std::size_t width = std::min(abreast, count - first);
    std::array<std::size_t, abreast> at{};
    for (std::size_t level = 0; level < depth; ++level) {
      for (std::size_t i = 0; i < width; ++i) {
        const std::size_t node = (first + i) * inner + at[i];
        at[i] = 2 * at[i] + (features[feature[node]] < threshold[node] ? 1 : 2);
      }
    }
    for (std::size_t i = 0; i < width; ++i) sum += leaf[(first + i) * leaves() + at[i] - inner];
  }
  return sum;
}

static void check_trees(const BoostedTrees& trees, std::size_t features) {
  constexpr std::size_t deepest = 16;
  const bool is_whole = trees.depth >= 1 && trees.depth <= deepest && !trees.leaf.empty() &&
                        trees.leaf.size() % trees.leaves() == 0 &&
                        trees.feature.size() == trees.trees() * trees.nodes() &&
                        trees.threshold.size() == trees.feature.size();
  const auto is_finite = [](float value) { return std::isfinite(value); };
  if (!(is_whole && std::isfinite(trees.bias) &&
        std::all_of(trees.feature.begin(), trees.feature.end(),
                    [&](std::uint8_t feature) { return feature < features; }) &&
        std::all_of(trees.threshold.begin(), trees.threshold.end(), is_finite) &&
        std::all_of(trees.leaf.begin(), trees.leaf.end(), is_finite))) {
    throw InputError("boosted trees: expected complete trees of features and finite numbers");
  }
}

template <typename Inputs>
BoostedTreesEstimator<Inputs>::BoostedTreesEstimator(BoostedTrees trees, const Config& config)
    : config_(config), trees_(std::move(trees)), inputs_(config.inputs) {
  check_trees(trees_, Inputs::count);
  reset();
}

template <typename Inputs>
void BoostedTreesEstimator<Inputs>::reset() noexcept {
  inputs_.reset();
  decision_ = {};
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
      wheel.contact =
          decision_[side].update(wheel.contact, wheel.p_contact, step.elapsed, config_.point);
    } else {  // the last decision holds
      wheel.p_contact = inputs_.relaxed(wheel.p_contact, step.elapsed);
      decision_[side].reset();
    }
  }
  multiply_wheels(belief_);
  return belief_;
}

template class BoostedTreesEstimator<SignalWindow>;
template class BoostedTreesEstimator<ChannelInputs>;

}  // namespace touchdown::experiments
