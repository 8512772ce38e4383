#pragma once

#include <string>
#include <vector>

#include "estimator/phase/filter.hpp"
#include "experiments/estimators/entry.hpp"

namespace touchdown::experiments {

/// The paper's Bayes filter in one of its configurations.
EstimatorEntry bayes_entry(const std::string& name, const std::string& summary,
                           const BayesFilterConfig& config);

/// The rungs between the configurations `paper` and `robust`, in their order
/// (estimator/bayes/ablation.hpp).
std::vector<EstimatorEntry> entries_from_paper_to_robust();

/// The paper's ablation: the robust measurement model without transitions.
EstimatorEntry measurement_only_entry();

/// The hidden Markov model over phases of contact.
EstimatorEntry phase_entry();

/// Rungs from the paper's ablation to the phase filter, with all of its inputs, bandwidths and
/// hysteresis: without phases, and without memory too.
EstimatorEntry hmm_entry();
EstimatorEntry hmm_without_memory_entry();

/// Its filter as such, for who wants to see the phases.
PhaseFilter phase_filter(const EstimatorEntry& entry, const EstimatorSetup& setup);

/// The paper's neural measurement network, as it is shipped.
EstimatorEntry neural_entry();

/// The same network, trained on the scenes that a benchmark's estimators are fitted to, through
/// sensors and noise (experiments/nmn_retrained.yaml).
EstimatorEntry retrained_neural_entry();

}  // namespace touchdown::experiments
