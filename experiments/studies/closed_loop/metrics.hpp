#pragma once

#include <cstdint>
#include <vector>

#include "odometry/wheeled_leg.hpp"
#include "recordings/recording.hpp"
#include "scoring/labels.hpp"
#include "scoring/transitions.hpp"

namespace touchdown::experiments {

/// What became of runs in which beliefs steered; sums, so they add. docs/closed_loop.md defines
/// each.
struct ClosedLoopMetrics {
  std::int64_t runs = 0;
  std::int64_t finished = 0;
  std::int64_t fell = 0;               ///< or diverged
  std::int64_t landings = 0;           ///< of wheels, after a flight that counts
  double squared_landing_speed = 0.0;  ///< of the tyres over the ground, at landings (m²/s²)
  double largest_pitch = 0.0;          ///< of each run, summed (rad)
  double largest_force = 0.0;          ///< normal, on one wheel, of each run, summed (N)
  std::int64_t false_takeoffs = 0;     ///< told of the robot
  std::int64_t contact_us = 0;         ///< in which a wheel touched (µs)

  double landing_speed_rms() const;          ///< m/s
  double mean_largest_pitch() const;         ///< rad
  double mean_largest_force() const;         ///< N
  double false_takeoffs_per_minute() const;  ///< of contact

  ClosedLoopMetrics& operator+=(const ClosedLoopMetrics& other);
};

/// One run's: as it was recorded by ideal sensors, of a robot that is as described, and what the
/// policy was told at every step (left, right), before it was late.
ClosedLoopMetrics closed_loop_metrics_of(const recordings::Recording& recording,
                       const std::array<scoring::ContactSequence, models::wheel_count>& told,
                       const odometry::WheeledBiped& robot, const scoring::LabelConfig& labels,
                       const scoring::ScoringConfig& scoring);

/// How fast the lowest point of each tyre moves over the ground along the robot's heading (m/s),
/// positive where the wheel turns faster than it travels.
std::array<double, models::wheel_count> tyre_speeds(const models::Observation& observation,
                                                    const models::GroundTruth& truth,
                                                    const odometry::WheeledBiped& robot);

}  // namespace touchdown::experiments
