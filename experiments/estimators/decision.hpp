#pragma once

#include <optional>
#include <string_view>

#include "estimator/evidence/curves.hpp"
#include "experiments/estimators/entry.hpp"

namespace touchdown::experiments {

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
std::optional<EvidenceCurveSets> evidence_in(const FittedModel& model);

}  // namespace touchdown::experiments
