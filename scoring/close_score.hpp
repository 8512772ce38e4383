#pragma once

#include <array>
#include <cstdint>

#include "scoring/score.hpp"

namespace touchdown::scoring {

/// What a close look at one run adds to its score, both wheels added; counts, so they add.
struct CloseScore {
  static constexpr std::int64_t first_ms = -60;  ///< latencies are counted from here on
  static constexpr std::size_t latencies = 311;  ///< one count per ms; the last takes all beyond

  Classification away_from_events;  ///< without ±20 ms of takeoffs and ±5 ms of landings
  Classification firm;              ///< without contact of less than 10 N
  std::array<std::int32_t, latencies> takeoff_ms{};  ///< detected takeoffs by their latency

  CloseScore& operator+=(const CloseScore& other);
  /// The least latency that so large a share of the detected takeoffs does not exceed (ms); NaN
  /// without any.
  double takeoff_percentile(double share) const;
};

/// `normal_force` per wheel and step (N).
CloseScore close_score(const std::array<ContactSequence, models::wheel_count>& truth,
                       const std::array<std::vector<double>, models::wheel_count>& normal_force,
                       const Prediction& prediction, std::int64_t period_us,
                       const ScoringConfig& config);

}  // namespace touchdown::scoring
