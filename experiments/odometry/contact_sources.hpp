#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/signals/run_signals.hpp"

namespace touchdown::experiments {

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
