#pragma once

#include <optional>

#include "estimator/evidence/curves.hpp"
#include "experiments/estimators/entry.hpp"

namespace touchdown::experiments {

/// A small network with interpretable input features (estimator/decision).
EstimatorEntry decision_network_entry();

/// The network's interpretable counterpart, a generalised additive model of evidence curves
/// (estimator/evidence): without tables for pairs of inputs, and with them.
EstimatorEntry evidence_curves_entry();
EstimatorEntry evidence_pairs_entry();

/// The averaged logits of curves and network (estimator/evidence/touchdown.hpp).
EstimatorEntry touchdown_entry();

/// The same with the shipped model, for users without labelled runs.
EstimatorEntry shipped_touchdown_entry();

/// The evidence curves of a model, if it has any. Errors: `InputError` for incomplete curves.
std::optional<EvidenceModel> evidence_in(const FittedModel& model);

}  // namespace touchdown::experiments
