#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "scoring/score.hpp"

namespace touchdown::scoring {

/// A number that a score can be asked for; NaN where it is not defined. docs/metrics.md defines
/// what is counted.
struct Metric {
  std::string name;  ///< as in a CSV header, unit last
  std::function<double(const Score&)> of;
  /// Of how many events it is the share that went well, where it is such a share.
  std::function<std::int64_t(const Score&)> events = {};
};

/// All of them, in the order of the tables: classification, transitions, latency, calibration.
const std::vector<Metric>& metrics();
/// Index of the metric with this name. Errors: `InputError` naming the nearest one.
std::size_t metric_index(std::string_view name);

/// What metrics are told of: both wheels pooled, then the views of `RobotScore`.
const std::vector<std::string>& scored_views();
/// The score of the view with this index.
Score score_of_view(const RobotScore& robot, std::size_t view);

}  // namespace touchdown::scoring
