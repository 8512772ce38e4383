#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/table.hpp"
#include "experiments/figures/figure_spec.hpp"
#include "experiments/results/samples.hpp"
#include "experiments/results/scores.hpp"

namespace touchdown::experiments {

inline constexpr std::array compared_metrics = {
    PointMetric{"accuracy", "success rate", &scoring::Classification::success},
    PointMetric{"balanced_accuracy", "balanced accuracy",
                &scoring::Classification::balanced_accuracy}};

/// A metric in both runs, over the samples that they have in common.
struct Movement {
  double before = 0.0;
  double after = 0.0;
  Interval difference = {};  ///< after minus before; without ends for one sample

  /// Whether zero lies outside the interval.
  bool has_moved() const { return difference.low > 0.0 || difference.high < 0.0; }
};

/// One condition in one noise cell of both runs.
struct ComparedCell {
  Condition condition;
  noise::NoiseCell noise;
  std::size_t pairs = 0;          ///< of equal samples
  bool has_equal_counts = false;  ///< in every pair
  std::array<Movement, compared_metrics.size()> metric = {};
};

struct Comparison {
  std::string before;  ///< run directories
  std::string after;
  double level = 0.95;                     ///< of the intervals
  std::vector<ComparedCell> cells = {};    ///< in the order of the second run
  std::vector<std::string> left_out = {};  ///< what is not compared, a line for each reason
};

/// Compares the cells that two runs have in common, sample by sample, with the intervals of the
/// second run's experiment. Errors: `InputError` when no cell can be compared.
Comparison compare(const SampledRun& before, const SampledRun& after);

/// A row per cell.
Table comparison_table(const Comparison& comparison);

/// The cells that moved in one metric, the largest differences first, and what chance explains.
std::string comparison_text(const Comparison& comparison, std::size_t metric);

/// A figure of `comparison_table`: the differences of one metric with their intervals, in the noise
/// settings with the largest ones. Without a change nothing is drawn.
FigureSpec comparison_figure(const Comparison& comparison, std::size_t metric);

}  // namespace touchdown::experiments
