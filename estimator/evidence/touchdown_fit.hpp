#pragma once

#include <functional>
#include <span>

#include "estimator/decision/config.hpp"
#include "estimator/evidence/touchdown.hpp"
#include "estimator/evidence/training.hpp"
#include "estimator/labelled_run.hpp"

namespace touchdown {

/// Fits curves and network separately to the same rows, which follow the network's configuration.
/// The same runs and configuration give the same numbers. Throws InputError as `fit_decision_model`
/// and `fit_evidence_model` do.
[[nodiscard]] TouchdownModel fit_touchdown_model(std::span<const LabelledRun> runs,
                                                 const DecisionConfig& config = {},
                                                 const DecisionFitConfig& network = {},
                                                 const EvidenceFitConfig& evidence = {},
                                                 const std::function<void()>& before_step = {});

}  // namespace touchdown
