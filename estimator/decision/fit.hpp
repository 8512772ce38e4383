#pragma once

#include <functional>
#include <span>

#include "estimator/decision/config.hpp"
#include "estimator/decision/training.hpp"
#include "estimator/labelled_run.hpp"

namespace touchdown {

/// What those learn from that hear `FeatureExtractor`: steps of both wheels of all runs at which they
/// would hear them, each run heard several times through other noise, biases and scales. Throws
/// InputError for labels that are not one per step, and where one class is missing.
[[nodiscard]] DecisionRows decision_rows(std::span<const LabelledRun> runs,
                                         const DecisionConfig& config,
                                         const DecisionFitConfig& fit);

/// What a logit that was fitted to these rows lacks, so that it means the probability of contact
/// as if every row weighed alike: ln of the weight of a row without contact to one in contact.
[[nodiscard]] float weights_offset(const DecisionRows& rows);

/// Fits the network to decide: cross-entropy with classes weighted, the weight taken off its logit
/// again, so that it means the probability of contact in runs like these. The same runs and
/// configuration give the same weights. Errors: as above, and for bad configurations.
[[nodiscard]] DecisionModel fit_decision_model(std::span<const LabelledRun> runs,
                                               const DecisionConfig& config = {},
                                               const DecisionFitConfig& fit = {},
                                               const std::function<void()>& before_step = {});

}  // namespace touchdown
