#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "estimator/contact_estimator.hpp"
#include "experiments/boosting/inputs.hpp"

namespace touchdown::experiments {

/// Boosted decision trees: the logit of contact is a bias plus one leaf of each tree. All trees are
/// complete binary trees of the same depth D. Nodes are numbered from the root: the children of
/// node i are 2i + 1, where its feature is below its threshold, and 2i + 2.
struct BoostedTrees {
  std::size_t depth = 0;
  float bias = 0.0F;                       ///< added to the sum
  std::vector<std::uint8_t> feature = {};  ///< 2^D − 1 for each tree
  std::vector<float> threshold = {};       ///< likewise
  std::vector<float> leaf = {};            ///< 2^D for each tree

  [[nodiscard]] std::size_t nodes() const noexcept { return (std::size_t{1} << depth) - 1; }
  [[nodiscard]] std::size_t leaves() const noexcept { return std::size_t{1} << depth; }
  [[nodiscard]] std::size_t trees() const noexcept { return leaf.size() / leaves(); }
  /// `features` has as many as the trees were checked for.
  [[nodiscard]] float logit(std::span<const float> features) const noexcept;
};

/// A reference upper bound of a benchmark: boosted trees on `SignalWindow` or `ChannelInputs`. It
/// shows how much these inputs contain. It is for studies, not for robots.
template <typename Inputs>
class BoostedTreesEstimator : public ContactEstimator {
 public:
  struct Config {
    TreeInputsConfig inputs = {};
    OperatingPoint point = network_point;
  };

  /// Throws InputError for incomplete trees, unknown features and numbers that are not finite.
  BoostedTreesEstimator(BoostedTrees trees, const Config& config);

  void reset() noexcept override;

 private:
  const Belief& estimate(const Signals& signals) noexcept override;

  Config config_;
  BoostedTrees trees_;
  Inputs inputs_;
  std::array<ContactDecision, 2> decision_{};
  Belief belief_;
};

}  // namespace touchdown::experiments
