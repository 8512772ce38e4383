#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/estimators/entry.hpp"

namespace touchdown::experiments {

// The entries of each file, in the order of tables.

std::vector<EstimatorEntry> filter_entries();     ///< filters by learned densities, and networks
std::vector<EstimatorEntry> observer_entries();   ///< of the robot's own software; a threshold
std::vector<EstimatorEntry> force_entries();      ///< by loads, as on legged robots
std::vector<EstimatorEntry> reference_entries();  ///< the best score, and that without any signal

/// The paper's Bayes filter in one of its configurations.
EstimatorEntry bayes_entry(const std::string& name, const std::string& summary,
                           const std::string& reason, const BayesFilterConfig& config);

/// The transition model of a Bayes filter.
TransitionConfig transition_of(const EstimatorEntry& entry);

}  // namespace touchdown::experiments
