#pragma once

#include <functional>
#include <span>

#include "estimator/decision/config.hpp"
#include "estimator/evidence/training.hpp"
#include "estimator/labelled_run.hpp"

namespace touchdown {

/// Fits evidence curves to the same rows as `fit_decision_model` fits the network. The logit means
/// the probability of contact in runs like these. The same runs and configuration give the same
/// numbers. Throws InputError as `fit_decision_model` does.
[[nodiscard]] EvidenceModel fit_evidence_model(std::span<const LabelledRun> runs,
                                               const DecisionConfig& config = {},
                                               const EvidenceFitConfig& fit = {},
                                               const std::function<void()>& before_step = {});

/// As above; with the load by the servo law, fits a second model without it to the same runs.
[[nodiscard]] EvidenceCurveSets fit_evidence_curve_sets(
    std::span<const LabelledRun> runs, const DecisionConfig& config = {},
    const EvidenceFitConfig& fit = {}, const std::function<void()>& before_step = {});

}  // namespace touchdown
