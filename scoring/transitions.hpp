#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "scoring/labels.hpp"

namespace touchdown::scoring {

/// How predictions are compared with the truth; docs/reference/metrics.md defines the windows.
struct ScoringConfig {
  double skip = 0.3;             ///< not scored at the beginning of a run (s)
  double hold_off = 0.25;        ///< further transitions are ignored for this long (s)
  double takeoff_opens = 0.06;   ///< a takeoff may be predicted this early (s)
  double landing_opens = 0.02;   ///< a landing may be predicted this early (s)
  double minimum_flight = 0.05;  ///< shorter flights are no events (s)
};

void describe(Fields& fields, ScoringConfig& scoring);

/// The first scored step of a run with steps of `period_us` (µs).
std::size_t first_scored_step(std::int64_t period_us, const ScoringConfig& config);

enum class EventKind : int { takeoff, landing };
enum class Judgement : int { detected, missed, false_alarm };

/// A true event that was detected or missed, or a predicted one that was a false alarm.
struct JudgedTransition {
  EventKind kind = EventKind::takeoff;
  Judgement verdict = Judgement::missed;
  std::size_t step = 0;      ///< of the true event; of the prediction for a false alarm
  std::int64_t latency = 0;  ///< steps from the true event to its detection; negative if early

  friend bool operator==(const JudgedTransition&, const JudgedTransition&) = default;
};

/// Matches predicted transitions with true ones, by docs/reference/metrics.md, "Transitions". Both
/// sequences have one state per step of `period` seconds. The result is ordered by kind, then time.
std::vector<JudgedTransition> judge_transitions(const ContactSequence& truth,
                                                const ContactSequence& predicted, double period,
                                                const ScoringConfig& config);

/// The steps of predicted switches in the scored part that detect no takeoff or landing of a
/// flight, however short. Missed ones do not offset them.
std::vector<std::size_t> extra_switches(const ContactSequence& truth,
                                        const ContactSequence& predicted, double period,
                                        const ScoringConfig& config);

/// Histogram of latencies: events per 5 ms, from 60 ms early to 250 ms late. The outermost bins
/// hold everything beyond. Counts add.
struct LatencyHistogram {
  static constexpr std::int64_t width_us = 5'000;
  static constexpr std::int64_t first_us = -60'000;  ///< centre of the first bin
  static constexpr std::size_t bins = 63;

  std::array<std::int32_t, bins> events{};

  /// Centre of a bin (ms).
  static constexpr double centre_ms(std::size_t bin) {
    return 1e-3 * static_cast<double>(first_us + static_cast<std::int64_t>(bin) * width_us);
  }

  void add(std::int64_t latency_us) {
    const std::int64_t last = static_cast<std::int64_t>(bins) - 1;
    const std::int64_t from_edge = latency_us - first_us + width_us / 2;
    events[static_cast<std::size_t>(std::clamp(from_edge / width_us, std::int64_t{0}, last))] += 1;
  }

  LatencyHistogram& operator+=(const LatencyHistogram& other) {
    for (std::size_t b = 0; b < bins; ++b) events[b] += other.events[b];
    return *this;
  }

  friend bool operator==(const LatencyHistogram&, const LatencyHistogram&) = default;
};

/// Counts of one kind of transition over one or many runs. Sums, so they add.
struct TransitionCounts {
  std::int64_t events = 0;
  std::int64_t detected = 0;
  std::int64_t false_alarms = 0;
  std::int64_t latency_us = 0;          ///< summed over detected events (µs)
  std::int64_t latency_us_squared = 0;  ///< squares, summed over detected events (µs²)
  LatencyHistogram latency;             ///< of detected events

  void add(const JudgedTransition& judged, std::int64_t period_us);
  TransitionCounts& operator+=(const TransitionCounts& other);

  double precision() const;
  double recall() const;
  /// Mean and standard deviation of the latency (s); NaN with too few detections.
  double latency_mean() const;
  double latency_deviation() const;

  friend bool operator==(const TransitionCounts&, const TransitionCounts&) = default;
};

}  // namespace touchdown::scoring
