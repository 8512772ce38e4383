#pragma once

#include "estimator/phase/filter.hpp"
#include "experiments/estimators/entry.hpp"

namespace touchdown::experiments {

/// The hidden Markov model over phases of contact.
EstimatorEntry phase_entry();

/// Its filter as such, for who wants to see the phases.
PhaseFilter phase_filter(const EstimatorEntry& entry, const EstimatorSetup& setup);

}  // namespace touchdown::experiments
