#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace touchdown::scoring {

/// How latencies are distributed: events per 5 ms, from 60 ms early to 250 ms late; the outermost
/// bins hold what lies beyond. Counts, so they add.
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

}  // namespace touchdown::scoring
