#pragma once

#include <array>
#include <cstdint>

#include "scoring/score.hpp"

namespace touchdown::scoring {

/// Latencies of detected events to the millisecond; counts, so they add.
struct Latencies {
  static constexpr std::int64_t first_ms = -60;  ///< they are counted from here on
  static constexpr std::size_t count = 311;      ///< one count per ms; the last takes all beyond

  std::array<std::int32_t, count> events{};

  void add(std::int64_t latency_us);
  Latencies& operator+=(const Latencies& other);
  std::int64_t total() const;
  /// The least latency, or the least |latency|, that so large a share of the events does not exceed
  /// (ms); NaN without any.
  double percentile(double share) const;
  double absolute_percentile(double share) const;
  /// The share that is told before it happens; NaN without any.
  double early_share() const;
};

/// Flights of a wheel as intervals: docs/metrics.md, "Flights".
struct FlightCounts {
  std::int64_t truth = 0;    ///< flights that must be found
  std::int64_t told = 0;     ///< maximal stretches told to be flights
  std::int64_t matched = 0;  ///< pairs of the two that share more than half of their union

  FlightCounts& operator+=(const FlightCounts& other);
  /// 2 matched / (truth + told); NaN without either.
  double f1() const { return ratio(2 * matched, truth + told); }
};

/// What a close look at one run adds to its score, both wheels added; counts, so they add.
struct ExtendedScore {
  Classification away_from_events;  ///< without ±20 ms of takeoffs and ±5 ms of landings
  Classification loaded;              ///< without contact of less than 10 N
  Latencies takeoff;
  Latencies landing;
  FlightCounts flights;
  std::int64_t extra_switches = 0;  ///< told, and the detection of no flight, however short
  double log_loss = 0.0;  ///< −ln of the probability given to the truth, 1e−6 at least, by step
  std::int64_t steps = 0;

  ExtendedScore& operator+=(const ExtendedScore& other);
};

/// `normal_force` per wheel and step (N).
ExtendedScore extended_score(const std::array<ContactSequence, models::wheel_count>& truth,
                       const std::array<std::vector<double>, models::wheel_count>& normal_force,
                       const Prediction& prediction, std::int64_t period_us,
                       const ScoringConfig& config);

}  // namespace touchdown::scoring
