#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/bootstrap.hpp"
#include "experiments/score.hpp"
#include "experiments/sweep.hpp"

namespace touchdown {

/// A number that a score can be asked for; docs/metrics.md defines each. Latencies are in
/// milliseconds.
struct Metric {
  std::string name;  ///< as in a CSV header, unit last
  std::function<double(const Score&)> of;
};

/// All of them, in the order of the tables: classification, transitions, latency, calibration.
const std::vector<Metric>& metrics();
/// Index of the metric with this name. Errors: `InputError` naming the nearest one.
std::size_t metric_index(std::string_view name);

/// The views of `RobotScore` and, first, both wheels pooled.
const std::vector<std::string>& scored_views();

/// Everything about one condition, noise cell and view, with intervals over runs or drops.
struct ScoreSummary {
  Condition condition;
  NoiseCell cell;
  std::string view;
  Score total;
  std::vector<Interval> metric;             ///< in the order of `metrics()`
  std::vector<Interval> contact_frequency;  ///< by bin of `total.calibration`

  const Interval& operator[](std::string_view name) const { return metric[metric_index(name)]; }
};

/// By condition, then view.
std::vector<ScoreSummary> summarise(const std::vector<ConditionScores>& scores,
                                    const NoiseCell& cell, const BootstrapConfig& bootstrap);

/// "first − second" in one metric, both wheels pooled, resampled on the same runs or drops.
struct Difference {
  std::string simulator;
  NoiseCell cell;
  std::string first;
  std::string second;
  std::vector<Interval> metric;  ///< in the order of `metrics()`
};

/// The first estimator of each engine against each of the others.
std::vector<Difference> differences(const std::vector<ConditionScores>& scores,
                                    const NoiseCell& cell, const BootstrapConfig& bootstrap);

}  // namespace touchdown
