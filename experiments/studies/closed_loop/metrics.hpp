#pragma once

#include <cstdint>
#include <vector>

#include "estimator/odometry/wheeled_leg.hpp"
#include "recordings/recording.hpp"
#include "scoring/labels.hpp"
#include "scoring/transitions.hpp"

namespace touchdown::experiments {

/// Closed-loop metrics, summed over runs. docs/reference/metrics.md defines each.
struct ClosedLoopMetrics {
  std::int64_t runs = 0;
  std::int64_t finished = 0;
  std::int64_t fell = 0;               ///< or diverged
  std::int64_t landings = 0;           ///< of wheels, after a flight of the minimum duration
  double squared_landing_speed = 0.0;  ///< slip speed of the tyres at landings, summed (m²/s²)
  double largest_pitch = 0.0;          ///< maximum of each run, summed (rad)
  double largest_force = 0.0;       ///< normal force on one wheel, maximum of each run, summed (N)
  std::int64_t false_takeoffs = 0;  ///< of the robot, in the recorded contact
  std::int64_t contact_us = 0;      ///< time with a wheel in contact (µs)

  double landing_speed_rms() const;          ///< m/s
  double mean_largest_pitch() const;         ///< rad
  double mean_largest_force() const;         ///< N
  double false_takeoffs_per_minute() const;  ///< per minute of contact

  ClosedLoopMetrics& operator+=(const ClosedLoopMetrics& other);
};

/// The metrics of one run. `recording` is from ideal sensors, `robot` as described by its file.
/// `trace` is the contact (left, right) at every step, before the policy's delay.
ClosedLoopMetrics closed_loop_metrics_of(
    const recordings::Recording& recording,
    const std::array<scoring::ContactSequence, models::wheel_count>& trace,
    const odometry::WheeledBiped& robot, const scoring::LabelConfig& labels,
    const scoring::ScoringConfig& scoring);

/// Slip speed of each tyre's lowest point over the ground along the robot's heading (m/s), positive
/// where the wheel turns faster than it travels.
std::array<double, models::wheel_count> tyre_speeds(const models::Observation& observation,
                                                    const models::GroundTruth& truth,
                                                    const odometry::WheeledBiped& robot);

}  // namespace touchdown::experiments
