#pragma once

#include "experiments/estimators/entry.hpp"

namespace touchdown::experiments {

/// The paper's Bayes filter in one of its configurations.
EstimatorEntry bayes_entry(const std::string& name, const std::string& summary,
                           const BayesFilterConfig& config);

/// The entry's configuration at another rate.
BayesFilterConfig config_at(const EstimatorEntry& entry, double sample_rate);

}  // namespace touchdown::experiments
