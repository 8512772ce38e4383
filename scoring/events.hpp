#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "scoring/classification.hpp"
#include "scoring/labels.hpp"
#include "scoring/transitions.hpp"

namespace touchdown::scoring {

/// Histogram of signed latencies in bins of 1 ms, to the longest that are matched. Counts add.
struct Latencies {
  static constexpr std::int64_t longest_ms = 100;
  static constexpr std::size_t bins = 2 * longest_ms + 1;

  std::array<std::int32_t, bins> events{};

  void add(std::int64_t latency_us);
  Latencies& operator+=(const Latencies& other);
  /// ms; of an even number of events, the mean of the middle two. NaN without events.
  double median() const;

  friend bool operator==(const Latencies&, const Latencies&) = default;
};

/// What estimators are ranked by: docs/reference/metrics.md, "Ranking". Sums over runs and wheels,
/// so they add. An event is a takeoff or landing of any flight, however short.
struct EventScore {
  static constexpr std::int64_t tolerance_us = 20'000;   ///< of matched events
  static constexpr std::int64_t long_error_us = 50'000;  ///< longer wrong intervals are counted

  std::int64_t truth = 0;     ///< true events
  std::int64_t decided = 0;   ///< events of the decision
  std::int64_t matched = 0;   ///< pairs of both
  std::int64_t extra = 0;     ///< decided events that detect no true one
  std::int64_t wrong_us = 0;  ///< in long wrong intervals (µs)
  Latencies takeoff;          ///< of pairs within `Latencies::longest_ms`; negative is early
  Latencies landing;

  EventScore& operator+=(const EventScore& other);
  /// NaN without events.
  double f1() const { return ratio(2 * matched, truth + decided); }

  friend bool operator==(const EventScore&, const EventScore&) = default;
};

/// Scores decisions about one wheel, one result per segment of the run (as `score`). A pair and its
/// latency belong to the segment of the true event, a wrong interval to that of its first step.
std::vector<EventScore> event_scores(const ContactSequence& truth, const ContactSequence& decided,
                                     const std::vector<std::size_t>& segments,
                                     std::int64_t period_us, const ScoringConfig& config);

}  // namespace touchdown::scoring
