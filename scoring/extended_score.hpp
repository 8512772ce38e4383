#pragma once

#include <array>
#include <cstdint>
#include <numeric>

#include "scoring/score.hpp"

namespace touchdown::scoring {

/// Estimated loads of wheels F̂ ± σ against true normal forces F: docs/reference/metrics.md,
/// "Loads". Counts of steps, so they add.
struct LoadScore {
  static constexpr double bin_width = 0.1;      ///< N, of the first bins of |F̂ − F|
  static constexpr std::size_t fine = 300;      ///< their number
  static constexpr double largest_fine = 30.0;  ///< N
  static constexpr double growth = 0.03;        ///< logarithm of the ratio of the others' ends
  static constexpr std::size_t count = 500;     ///< of all bins; the last holds all from 12 kN on
  std::array<std::int32_t, count> errors{};     ///< steps with a load
  std::int64_t covered = 0;                     ///< steps with |F̂ − F| ≤ 2σ
  std::int64_t steps = 0;                       ///< all

  void add(double normal_force, const WheelLoad& load);
  LoadScore& operator+=(const LoadScore& other);
  std::int64_t known() const {
    return std::accumulate(errors.begin(), errors.end(), std::int64_t{0});
  }
  /// Median of |F̂ − F| (N), to half a bin: 0.05 N, from 30 N on 1.5 %; NaN without loads.
  double median_error() const;
  /// The share of steps with a load that have |F̂ − F| ≤ 2σ; NaN without loads.
  double coverage() const { return ratio(covered, known()); }
  /// The share of steps with a load.
  double share() const { return ratio(known(), steps); }
};

/// Additional metrics of one or many runs, summed over both wheels and over steps, so they add.
struct ExtendedScore {
  Classification loaded;  ///< without contact of less than 10 N
  LoadScore load;
  double log_loss = 0.0;  ///< Σ over steps of −ln max(P(truth), 1e−6)
  std::int64_t steps = 0;

  ExtendedScore& operator+=(const ExtendedScore& other);
};

/// Scores one run. `normal_force` is per wheel and step (N); `period_us` is the time step (µs).
ExtendedScore extended_score(
    const std::array<ContactSequence, models::wheel_count>& truth,
    const std::array<std::vector<double>, models::wheel_count>& normal_force,
    const Prediction& prediction, std::int64_t period_us, const ScoringConfig& config);

}  // namespace touchdown::scoring
