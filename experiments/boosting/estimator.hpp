#pragma once

#include "estimator/contact_estimator.hpp"
#include "experiments/boosting/trees.hpp"
#include "experiments/boosting/window.hpp"

namespace touchdown::experiments {

/// The reference upper bound of a benchmark: boosted trees on 100 ms of the phase filter's signals.
/// It shows how much these signals contain. It is for studies, not for robots.
class BoostedTreesEstimator : public ContactEstimator {
 public:
  struct Config {
    double sample_rate = 1000.0;  ///< Hz
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
  SignalWindow window_;
  Belief belief_;
};

}  // namespace touchdown::experiments
