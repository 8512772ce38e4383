#pragma once

#include "estimator/contact_estimator.hpp"
#include "estimator/evidence/curves.hpp"

namespace touchdown {

/// What the inputs of one wheel add to its log-odds, by groups of channels (nats). The groups add
/// up to `evidence_logit`, but for rounding.
[[nodiscard]] Evidence::Contributions evidence_contributions(
    const EvidenceModel& model, const DecisionInputs& inputs,
    const ServoLoadInputs& servo = {}) noexcept;

}  // namespace touchdown
