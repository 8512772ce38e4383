#pragma once

#include <memory>
#include <string>
#include <vector>

#include "estimator/phase/filter.hpp"
#include "experiments/estimators/entry.hpp"

namespace touchdown::experiments {

/// The paper's Bayes filter in one of its configurations.
EstimatorEntry bayes_entry(const std::string& name, const std::string& summary,
                           const std::string& reason, const BayesFilterConfig& config);

/// The paper's ablation: the robust measurement model without transitions.
EstimatorEntry measurement_only_entry();

/// The hidden Markov model over phases of contact.
EstimatorEntry phase_entry();

/// The phase filter without phases, with its inputs, bandwidths and hysteresis.
EstimatorEntry hmm_entry();

/// The fitted phase model; filters share it.
std::shared_ptr<const PhaseModel> phase_model(const EstimatorSetup& setup);

/// The phase filter itself, for callers that need the probabilities of phases.
PhaseFilter phase_filter(const EstimatorEntry& entry, const EstimatorSetup& setup);

/// The paper's neural measurement network with the shipped weights.
EstimatorEntry neural_entry();

/// The same network, trained on the fit scenes of a benchmark with sensor model and noise
/// (experiments/nmn_retrained.yaml).
EstimatorEntry retrained_neural_entry();

}  // namespace touchdown::experiments
