#pragma once

#include <string_view>

#include "experiments/estimators/entry.hpp"

namespace touchdown::experiments {

/// The estimator that every table shows beside the others.
inline constexpr std::string_view always_contact_name = "always_contact";

/// The estimator that does not listen: P(contact) = 1. Its success rate is the share of contact in
/// the test runs, which every other success rate has to be read against.
EstimatorEntry always_contact_entry();

}  // namespace touchdown::experiments
