#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/fields.hpp"
#include "experiments/config/experiment.hpp"

namespace touchdown::experiments {

/// The names of all estimators that the experiment can use: built-in ones, then its external ones.
std::vector<std::string> estimator_names(const Experiment& experiment);

/// The estimator of this name, built-in or one of the experiment's external ones, which live as
/// long as the experiment. Errors: `InputError` with the nearest known name.
const EstimatorEntry& estimator_entry(const Experiment& experiment, std::string_view name);

/// Describes a list of different estimators, each one of the experiment's own.
KeyNotes own_estimators(Fields& fields, std::string_view key, const Experiment& experiment,
                        std::vector<std::string>& names);

}  // namespace touchdown::experiments
