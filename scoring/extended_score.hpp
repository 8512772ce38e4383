#pragma once

#include <array>
#include <cstdint>
#include <numeric>

#include "scoring/score.hpp"

namespace touchdown::scoring {

/// Histogram of the latencies of detected events, in bins of 1 ms. Counts add.
struct Latencies {
  static constexpr std::int64_t first_ms =
      -60;  ///< latency of the first bin; it holds all earlier events
  static constexpr std::size_t count = 311;  ///< bins; the last holds all later events

  std::array<std::int32_t, count> events{};

  void add(std::int64_t latency_us);
  Latencies& operator+=(const Latencies& other);
  std::int64_t total() const;
  /// The smallest latency, or |latency|, that at least `share` of the events do not exceed (ms);
  /// NaN without events.
  double percentile(double share) const;
  double absolute_percentile(double share) const;
  /// Median of |latency| (ms): of an even number of events, the mean of the middle two. NaN without
  /// events.
  double absolute_median() const;
  /// Share of the events with a negative latency; NaN without events.
  double early_share() const;

 private:
  Latencies absolute() const;
  /// The latency of the event with this rank, counted from 1 (ms); NaN if there are fewer.
  double ranked(std::int64_t rank) const;
};

/// Flights of a wheel as intervals: docs/reference/metrics.md, "Flights".
struct FlightCounts {
  std::int64_t truth = 0;      ///< true flights of at least the minimum duration
  std::int64_t predicted = 0;  ///< maximal intervals that are predicted as flight
  std::int64_t matched = 0;    ///< pairs that share more than half of their union

  FlightCounts& operator+=(const FlightCounts& other);
  /// 2 matched / (truth + predicted); NaN if both are zero.
  double f1() const { return ratio(2 * matched, truth + predicted); }
};

/// Estimated loads of wheels F̂ ± σ against true normal forces F: docs/reference/metrics.md,
/// "Loads". Counts of steps, so they add.
struct LoadScore {
  static constexpr double bin_width = 0.1;   ///< N
  static constexpr std::size_t count = 300;  ///< bins of |F̂ − F|; the last holds all larger ones
  std::array<std::int32_t, count> errors{};  ///< steps with a load
  std::int64_t covered = 0;                  ///< steps with |F̂ − F| ≤ 2σ
  std::int64_t steps = 0;                    ///< all

  void add(double normal_force, const WheelLoad& load);
  LoadScore& operator+=(const LoadScore& other);
  std::int64_t known() const {
    return std::accumulate(errors.begin(), errors.end(), std::int64_t{0});
  }
  /// Median of |F̂ − F|, to half a bin (N); NaN without loads.
  double median_error() const;
  /// The share of steps with a load that have |F̂ − F| ≤ 2σ; NaN without loads.
  double coverage() const { return ratio(covered, known()); }
  /// The share of steps with a load.
  double share() const { return ratio(known(), steps); }
};

/// Additional metrics of one or many runs, summed over both wheels and over steps, so they add.
struct ExtendedScore {
  Classification away_from_events;  ///< without ±20 ms of takeoffs and ±5 ms of landings
  Classification loaded;            ///< without contact of less than 10 N
  Latencies takeoff;
  Latencies landing;
  FlightCounts flights;
  LoadScore load;
  std::int64_t extra_switches = 0;  ///< predicted switches that detect no flight, however short
  double log_loss = 0.0;            ///< Σ over steps of −ln max(P(truth), 1e−6)
  std::int64_t steps = 0;

  ExtendedScore& operator+=(const ExtendedScore& other);
};

/// Scores one run. `normal_force` is per wheel and step (N); `period_us` is the time step (µs).
ExtendedScore extended_score(
    const std::array<ContactSequence, models::wheel_count>& truth,
    const std::array<std::vector<double>, models::wheel_count>& normal_force,
    const Prediction& prediction, std::int64_t period_us, const ScoringConfig& config);

}  // namespace touchdown::scoring
