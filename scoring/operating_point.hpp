#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scoring/score.hpp"

namespace touchdown::scoring {

/// A decision with hysteresis: a wheel leaves contact when P(contact) falls below one threshold and
/// returns above the other one, which is no lower.
struct Hysteresis {
  double leave_below = 0.5;
  double return_above = 0.5;

  friend bool operator==(const Hysteresis&, const Hysteresis&) = default;
};

/// What is decided at every step, in contact before the first one.
ContactSequence decisions(const std::vector<double>& p_contact, const Hysteresis& thresholds);

/// What one decision about both wheels of one or many runs is worth; sums, so they add.
/// docs/metrics.md, "Operating points".
struct OperatingScore {
  Classification points;
  std::int64_t extra_switches = 0;
  std::int64_t false_takeoffs = 0;
  std::int64_t flights = 0;           ///< whose takeoffs must be found
  std::int64_t found = 0;             ///< of these
  std::int64_t takeoff_error_us = 0;  ///< |latency|, summed over those that are found
  std::int64_t scored_us = 0;         ///< of both wheels together

  OperatingScore& operator+=(const OperatingScore& other);
  /// NaN where there is nothing to divide by.
  double extra_switches_per_flight() const { return ratio(extra_switches, flights); }
  double extra_switches_per_minute() const { return 60e6 * ratio(extra_switches, scored_us); }
  double false_takeoffs_per_minute() const { return 60e6 * ratio(false_takeoffs, scored_us); }
  double takeoff_recall() const { return ratio(found, flights); }
  double takeoff_error() const { return 1e-6 * ratio(takeoff_error_us, found); }  ///< s
};

/// Of one run.
OperatingScore operating_score(const std::array<ContactSequence, models::wheel_count>& truth,
                               const std::array<ContactSequence, models::wheel_count>& decided,
                               std::int64_t period_us, const ScoringConfig& config);

}  // namespace touchdown::scoring
