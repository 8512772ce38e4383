#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

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

/// P(contact) of each wheel at every step.
using ContactTrack = std::array<std::vector<double>, models::wheel_count>;

/// Contact sources of odometry that are no estimators: the labels, without and with these delays
/// (s). They are oracles: no robot has them, and nothing is ever fitted to them.
std::vector<std::string> oracle_names(const std::vector<double>& delays);
/// Their tracks through a run, in the same order. A delayed track starts in contact.
std::vector<ContactTrack> oracle_tracks(const std::vector<double>& delays, const RunSignals& run);

/// The name in tables of an estimator that is odometry's contact source: `always` for
/// `always_contact`, else its own name.
std::string contact_name(std::string_view estimator);

/// The title of a contact source: "Always contact", "Truth (oracle)", "Truth, delayed 20 ms
/// (oracle)", an estimator's title.
std::string contact_title(const std::string& contact);

}  // namespace touchdown::experiments
