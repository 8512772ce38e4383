#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "estimator/evidence/curves.hpp"
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

/// The phase filter itself, for callers that need the probabilities of phases.
PhaseFilter phase_filter(const EstimatorEntry& entry, const EstimatorSetup& setup);

/// The transition model of a Bayes filter.
TransitionConfig transition_of(const EstimatorEntry& entry);

/// The paper's neural measurement network with the shipped weights.
EstimatorEntry neural_entry();

/// The same network, trained on the fit scenes of a benchmark with sensor model and noise
/// (experiments/nmn_retrained.yaml).
EstimatorEntry retrained_neural_entry();

/// A threshold on each wheel's load, as teams with wheeled legs use it. It needs no fit.
EstimatorEntry support_force_entry();

/// Published estimators for legged robots, applied to wheels.
EstimatorEntry force_kinematics_entry();

/// A small network with interpretable input features (estimator/decision).
EstimatorEntry decision_network_entry();

/// A generalised additive model of evidence curves (estimator/evidence), the recommended estimator:
/// at its balanced and at its quiet operating point.
EstimatorEntry evidence_curves_entry();
EstimatorEntry quiet_evidence_curves_entry();

/// The same with the shipped models, for users without labelled runs.
EstimatorEntry shipped_curves_entry();
EstimatorEntry quiet_shipped_curves_entry();

/// The file of the shipped model of `shipped` or `shipped_quiet` (core/resources.hpp).
const char* shipped_file(std::string_view estimator);

/// The evidence curves of a model, if it has any. Errors: `InputError` for incomplete curves.
std::optional<EvidenceCurveSets> evidence_in(const Model& model);

/// Boosted trees, the reference upper bounds of a benchmark: on the channels of the recommended
/// estimator, and on all raw signals with the torques by the laws of the servos.
EstimatorEntry boosted_channels_entry();
EstimatorEntry boosted_signals_entry();

}  // namespace touchdown::experiments
