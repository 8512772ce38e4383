#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "estimator/evidence/curves.hpp"
#include "estimator/phase/filter.hpp"
#include "experiments/estimators/entry.hpp"

namespace touchdown::experiments {

// The entries of each file, in the order of tables.

std::vector<EstimatorEntry> filter_entries();     ///< filters by learned densities, and networks
std::vector<EstimatorEntry> observer_entries();   ///< of the robot's own software; a threshold
std::vector<EstimatorEntry> force_entries();      ///< by loads, as on legged robots
std::vector<EstimatorEntry> evidence_entries();   ///< fitted and shipped evidence curves
std::vector<EstimatorEntry> boosted_entries();    ///< the reference upper bounds of a benchmark
std::vector<EstimatorEntry> reference_entries();  ///< the best score, and that without any signal

/// The paper's Bayes filter in one of its configurations.
EstimatorEntry bayes_entry(const std::string& name, const std::string& summary,
                           const std::string& reason, const BayesFilterConfig& config);

/// A generalised additive model of evidence curves (estimator/evidence), the recommended estimator.
EstimatorEntry evidence_curves_entry();

/// The phase filter itself, for callers that need the probabilities of phases.
PhaseFilter phase_filter(const EstimatorEntry& entry, const EstimatorSetup& setup);

/// The transition model of a Bayes filter.
TransitionConfig transition_of(const EstimatorEntry& entry);

/// The file of the shipped model of `shipped` or `shipped_quiet` (core/resources.hpp).
const char* shipped_file(std::string_view estimator);

/// The evidence curves of a model, if it has any. Errors: `InputError` for incomplete curves.
std::optional<EvidenceCurveSets> evidence_in(const Model& model);

}  // namespace touchdown::experiments
