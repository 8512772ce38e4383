#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "estimator/decision/augmentation.hpp"
#include "estimator/force/leg_geometry.hpp"
#include "estimator/labelled_run.hpp"
#include "experiments/boosting/bins.hpp"
#include "experiments/boosting/trees.hpp"

namespace touchdown::experiments {

struct BoostingConfig {
  std::uint64_t seed = 1;      ///< of all random draws
  std::size_t passes = 12;     ///< augmentation passes over each run
  std::size_t rows = 200'000;  ///< approximate number of training rows, one per step and wheel
  std::size_t trees = 120;
  std::size_t depth = 6;  ///< of each tree
  double learning_rate = 0.15;
  /// A class has the weight of its count to this power: 0 weighs all steps alike, −1 both classes.
  /// The weights' shift of the logit is removed, so the logit gives the probability in such runs.
  double class_exponent = -0.5;
  double least_weight = 20.0;  ///< of a leaf: Σ p (1 − p) of its rows
  AugmentationConfig augmentation = {};
  LegGeometry legs = {};    ///< as in `TreeInputsConfig`, of all runs
  bool servo_load = false;  ///< likewise
};

/// Training data: the bins of the features of one row after the other, and 1 for rows in contact, 0
/// for others.
struct BoostingRows {
  FeatureBins bins;
  std::vector<std::uint8_t> features;
  std::vector<float> is_contact;

  [[nodiscard]] std::size_t count() const noexcept { return is_contact.size(); }
  [[nodiscard]] std::size_t width() const noexcept { return bins.width(); }
};

/// Rows with bins of their own: features of one row after the other, as many for each.
BoostingRows binned(std::span<const float> features, std::vector<float> is_contact);

/// Draws training rows from labelled runs, with `SignalWindow` or `ChannelInputs`. The first rows,
/// of whole passes, decide the bins of all. `before_run` is called before each pass through a run;
/// an exception from it ends the work. Throws InputError unless there is one label per step.
template <typename Inputs>
BoostingRows boosting_rows(std::span<const LabelledRun> runs, const BoostingConfig& config,
                           const std::function<void()>& before_run = {});

/// Fits trees by XGBoost to the log loss, on one thread: the same rows give the same trees.
/// `before_tree` is called before each tree; an exception from it ends the fit. Throws InputError
/// without rows of both classes, and Error for errors of the library.
BoostedTrees fit_trees(BoostingRows rows, const BoostingConfig& config,
                       const std::function<void()>& before_tree = {});

}  // namespace touchdown::experiments
