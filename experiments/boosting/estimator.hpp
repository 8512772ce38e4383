#pragma once

#include "estimator/contact_estimator.hpp"
#include "experiments/boosting/inputs.hpp"
#include "experiments/boosting/trees.hpp"

namespace touchdown::experiments {

/// A reference upper bound of a benchmark: boosted trees on `SignalWindow` or `ChannelInputs`. It
/// shows how much these inputs contain. It is for studies, not for robots.
template <typename Inputs>
class BoostedTreesEstimator : public ContactEstimator {
 public:
  struct Config {
    TreeInputsConfig inputs = {};
    /// A wheel leaves contact when P(contact) falls below `leave_below`, and returns to contact
    /// above `return_above`.
    double leave_below = 0.75;
    double return_above = 0.9;
  };

  /// Errors: those of `check_trees`.
  BoostedTreesEstimator(BoostedTrees trees, const Config& config);

  void reset() noexcept override;

 private:
  const Belief& estimate(const Signals& signals) noexcept override;

  Config config_;
  BoostedTrees trees_;
  Inputs inputs_;
  Belief belief_;
};

}  // namespace touchdown::experiments
