#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "estimator/decision/operating_point.hpp"
#include "scoring/score.hpp"

namespace touchdown::scoring {

/// The decision at every step of `period` seconds. The wheel starts in contact.
ContactSequence decisions(const std::vector<double>& p_contact, double period,
                          const OperatingPoint& point);

/// Score of the decisions about both wheels, over one or many runs. Sums, so they add.
/// docs/reference/metrics.md, "Operating points".
struct OperatingScore {
  Classification points;
  std::int64_t extra_switches = 0;
  std::int64_t false_takeoffs = 0;
  std::int64_t flights = 0;           ///< true flights of at least the minimum duration
  std::int64_t found = 0;             ///< flights with a detected takeoff
  std::int64_t takeoff_error_us = 0;  ///< |latency|, summed over the detected takeoffs
  std::int64_t scored_us = 0;         ///< scored time, both wheels added

  OperatingScore& operator+=(const OperatingScore& other);
  /// NaN if the denominator is zero, as the rates below.
  double balanced_accuracy() const { return points.balanced_accuracy(); }
  double extra_switches_per_flight() const { return ratio(extra_switches, flights); }
  double extra_switches_per_minute() const { return 60e6 * ratio(extra_switches, scored_us); }
  double false_takeoffs_per_minute() const { return 60e6 * ratio(false_takeoffs, scored_us); }
  double takeoff_recall() const { return ratio(found, flights); }
  double takeoff_error() const { return 1e-6 * ratio(takeoff_error_us, found); }  ///< s
};

/// Scores the decisions of one run. `period_us` is the time step (µs).
OperatingScore operating_score(const std::array<ContactSequence, models::wheel_count>& truth,
                               const std::array<ContactSequence, models::wheel_count>& decided,
                               std::int64_t period_us, const ScoringConfig& config);

}  // namespace touchdown::scoring
