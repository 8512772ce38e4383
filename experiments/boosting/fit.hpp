#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "estimator/decision/augmentation.hpp"
#include "estimator/labelled_run.hpp"
#include "experiments/boosting/trees.hpp"

namespace touchdown::experiments {

struct BoostingConfig {
  std::uint64_t seed = 1;      ///< of everything that is drawn
  std::size_t passes = 12;     ///< how often each run is heard, disturbed anew each time
  std::size_t rows = 200'000;  ///< about so many steps of wheels are learned from
  std::size_t trees = 120;
  std::size_t depth = 6;  ///< of each tree
  double learning_rate = 0.15;
  /// A class weighs as the power of its count: 0 every step alike, −1 both classes alike. What
  /// weights add to the logit is taken off again: it means the probability in runs like these.
  double class_exponent = -0.5;
  double least_weight = 20.0;  ///< of a leaf: Σ p (1 − p) of its rows
  AugmentationConfig disturbance = {};
};

/// What trees learn from: one row after the other, and whether it is one in contact.
struct BoostingRows {
  std::vector<float> features;
  std::vector<float> is_contact;

  [[nodiscard]] std::size_t count() const noexcept { return is_contact.size(); }
};

/// Throws InputError for labels that are not one per step.
BoostingRows boosting_rows(std::span<const LabelledRun> runs, const BoostingConfig& config);

/// Fits trees by XGBoost to the log loss, on one thread: the same rows give the same trees.
/// `before_tree` is called before each: what it throws ends the fit. Throws InputError without rows
/// of both classes, and Error for what the library complains of.
BoostedTrees fit_trees(const BoostingRows& rows, const BoostingConfig& config,
                       const std::function<void()>& before_tree = {});

}  // namespace touchdown::experiments
