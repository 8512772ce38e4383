#pragma once

#include <optional>

#include "estimator/evidence/curves.hpp"
#include "experiments/estimators/entry.hpp"

namespace touchdown::experiments {

/// A small network that is fitted to decide, from channels that one can name.
EstimatorEntry decision_network_entry();

/// The same with weights that are shipped, for who has no labelled runs.
EstimatorEntry shipped_decision_network_entry();

/// The network's transparent twin, curves of evidence that are added (estimator/evidence): without
/// tables of pairs, and with them.
EstimatorEntry evidence_curves_entry();
EstimatorEntry evidence_pairs_entry();

/// The curves of a model that has some. Errors: `InputError` for one that lacks a part of them.
std::optional<EvidenceModel> evidence_in(const FittedModel& model);

}  // namespace touchdown::experiments
