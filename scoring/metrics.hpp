#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "scoring/score.hpp"

namespace touchdown::scoring {

/// A number computed from a score; NaN where it is not defined. docs/reference/metrics.md defines
/// the counts.
struct Metric {
  std::string name;  ///< as in a CSV header, unit last
  std::function<double(const Score&)> of;
  /// The number of events in the denominator, if the metric is a share of events.
  std::function<std::int64_t(const Score&)> events = {};
};

/// All metrics, in the order of the tables: classification, transitions, latency, calibration.
const std::vector<Metric>& metrics();
/// Index of the metric with this name. Errors: `InputError` naming the nearest one.
std::size_t metric_index(std::string_view name);

/// Names of the views that are scored: both wheels pooled, then the views of `RobotScore`.
const std::vector<std::string>& scored_views();
/// The score of a view, by its index in `scored_views()`.
Score score_of_view(const RobotScore& robot, std::size_t view);

}  // namespace touchdown::scoring
