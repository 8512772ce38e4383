#pragma once

#include <array>
#include <span>

#include "experiments/signals/run_signals.hpp"
#include "scoring/trajectory.hpp"

namespace touchdown::experiments {

/// P(contact) of each wheel at every step of a run.
using TrackView = std::array<std::span<const double>, models::wheel_count>;

/// The way that odometry tells of a run (which has its motion) by what is heard of it, contact as
/// it is told. At a step of which nothing is heard the last state stands.
scoring::Trajectory dead_reckoned(const RunSignals& run, const NoiseRun& noise,
                                  const noise::SensorNoise& levels, const TrackView& p_contact);

/// It, scored.
scoring::TrajectoryScore score_odometry(const RunSignals& run, const NoiseRun& noise,
                                        const noise::SensorNoise& levels,
                                        const TrackView& p_contact,
                                        const scoring::ScoringConfig& scoring);

}  // namespace touchdown::experiments
