#pragma once

#include <optional>

#include "estimator/evidence/curves.hpp"
#include "experiments/estimators/entry.hpp"

namespace touchdown::experiments {

/// A small network that is fitted to decide, from channels that one can name.
EstimatorEntry decision_network_entry();

/// The network's transparent twin, curves of evidence that are added (estimator/evidence): without
/// tables of pairs, and with them.
EstimatorEntry evidence_curves_entry();
EstimatorEntry evidence_pairs_entry();

/// Curves and network side by side (estimator/evidence/touchdown.hpp).
EstimatorEntry touchdown_entry();

/// The same with a model that is shipped, for who has no labelled runs.
EstimatorEntry shipped_touchdown_entry();

/// The curves of a model that has some. Errors: `InputError` for one that lacks a part of them.
std::optional<EvidenceModel> evidence_in(const FittedModel& model);

}  // namespace touchdown::experiments
