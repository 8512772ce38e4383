#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/config/experiment.hpp"
#include "experiments/signals/run_signals.hpp"

namespace touchdown::experiments {

/// P(contact) of each wheel at every step.
using ContactTrack = std::array<std::vector<double>, models::wheel_count>;

/// What tells odometry about contact and is no estimator: the labels, at once and late. Oracles,
/// all of them: no robot has them, and nothing is ever fitted to them.
std::vector<std::string> oracle_names(const OdometryStudyConfig& config);
/// Their tracks through a run, in the same order. Before what is late there is contact.
std::vector<ContactTrack> oracle_tracks(const OdometryStudyConfig& config, const RunSignals& run);

/// As tables name an estimator that tells odometry: `always` for the one that believes nothing
/// else.
std::string contact_name(std::string_view estimator);

/// The same for people: "Always contact", "Truth (oracle)", "Truth, 20 ms late (oracle)", an
/// estimator's title.
std::string contact_title(const std::string& contact);

}  // namespace touchdown::experiments
