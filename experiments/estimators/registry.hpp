#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/estimators/baselines.hpp"
#include "experiments/estimators/entry.hpp"

namespace touchdown::experiments {

/// Every estimator an experiment can name, in the order of tables.
std::span<const EstimatorEntry> estimator_entries();
std::vector<std::string> estimator_names();

/// Errors: `InputError` naming the nearest one.
const EstimatorEntry& estimator_entry(std::string_view name);

}  // namespace touchdown::experiments
