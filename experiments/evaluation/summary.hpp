#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/evaluation/tasks.hpp"
#include "experiments/plan/condition.hpp"
#include "scoring/bootstrap.hpp"
#include "scoring/score.hpp"

namespace touchdown::experiments {

/// The scores of one condition, noise cell and view, with intervals over runs or drops.
struct ScoreSummary {
  Condition condition;
  noise::NoiseCell cell;
  std::string view;
  scoring::Score total;
  std::vector<Interval> metric;             ///< in the order of `metrics()`
  std::vector<Interval> contact_frequency;  ///< by bin of `total.calibration`

  const Interval& operator[](std::string_view name) const {
    return metric[scoring::metric_index(name)];
  }
};

/// Returns summaries by cell, then condition, then view. `cells` are the cells of the scores.
std::vector<ScoreSummary> summarise(const std::vector<ConditionScores>& scores,
                                    std::span<const noise::NoiseCell> cells,
                                    const scoring::BootstrapConfig& bootstrap);

/// "first − second" in each metric, both wheels pooled, with resampling of the same runs or drops.
struct Difference {
  std::string simulator;
  noise::NoiseCell cell;
  std::string first;
  std::string second;
  std::vector<Interval> metric;  ///< in the order of `metrics()`
};

/// By cell, the differences of each engine's first estimator from each of the others.
std::vector<Difference> differences(const std::vector<ConditionScores>& scores,
                                    std::span<const noise::NoiseCell> cells,
                                    const scoring::BootstrapConfig& bootstrap);

}  // namespace touchdown::experiments
