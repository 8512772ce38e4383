#pragma once

#include <array>
#include <span>

#include "experiments/signals/run_signals.hpp"
#include "scoring/trajectory.hpp"

namespace touchdown::experiments {

/// P(contact) of each wheel at every step of a run.
using TrackView = std::array<std::span<const double>, models::wheel_count>;

/// Odometry's trajectory of a run with this contact. The run must have its motion. At a step
/// without a record the last state holds.
scoring::Trajectory dead_reckoned(const RunSignals& run, const NoiseRun& noise,
                                  const noise::SensorNoise& levels, const TrackView& p_contact);

/// The score of that trajectory against the run's motion.
scoring::TrajectoryScore score_odometry(const RunSignals& run, const NoiseRun& noise,
                                        const noise::SensorNoise& levels,
                                        const TrackView& p_contact,
                                        const scoring::ScoringConfig& scoring);

}  // namespace touchdown::experiments
