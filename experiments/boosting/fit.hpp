#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "estimator/decision/augmentation.hpp"
#include "estimator/force/leg_geometry.hpp"
#include "estimator/labelled_run.hpp"
#include "experiments/boosting/estimator.hpp"

namespace touchdown::experiments {

/// At most 256 bins of every feature, so that a row needs a byte for each. Trees split between
/// bins: bin b holds the values of at least `cut(b − 1)` and below `cut(b)`.
class FeatureBins {
 public:
  static constexpr std::size_t most = 256;

  FeatureBins() = default;
  /// Bins of about equally many of these rows, which follow each other with `width` finite values
  /// each. Features with at most `most` different values get a bin for each.
  FeatureBins(std::span<const float> rows, std::size_t width);

  [[nodiscard]] std::size_t width() const noexcept { return count_.size(); }
  /// Appends the bins of one row of `width` values.
  void append(std::span<const float> row, std::vector<std::uint8_t>& bins) const;
  /// The threshold between values in bins below `bin` and the others; `bin` is at least 1. Beyond
  /// the last bin no value is larger.
  [[nodiscard]] float threshold(std::size_t feature, std::size_t bin) const noexcept;

 private:
  [[nodiscard]] std::uint8_t bin(std::size_t feature, float value) const noexcept;

  std::vector<std::array<float, most - 1>> cuts_;  ///< by feature, ascending
  std::vector<std::size_t> count_;                 ///< of its cuts
};

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
