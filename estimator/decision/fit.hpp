#pragma once

#include <functional>
#include <span>

#include "estimator/decision/config.hpp"
#include "estimator/decision/descent.hpp"
#include "estimator/decision/network.hpp"
#include "estimator/labelled_run.hpp"

namespace touchdown {

/// The weighted mean of the cross-entropy of these rows, each in a column of its own; `gradient`,
/// unless null, gets its gradient. If the rows have the load by the servo law, model and gradient
/// need weights for it.
[[nodiscard]] double decision_loss(const DecisionModel& model, const DecisionRows& rows,
                                   DecisionModel* gradient = nullptr);

/// Draws weights by He's rule, then runs `descend`. The same rows and seed give the same weights.
/// `before_step` is called every 64 steps; an exception from it ends the training.
[[nodiscard]] DecisionModel train_decision_model(const DecisionRows& rows,
                                                 const DecisionFitConfig& config,
                                                 const std::function<void()>& before_step = {});

/// The rows that models on `FeatureExtractor` are fitted to: steps of both wheels of all runs,
/// where inputs are valid. Each run gives several augmentation passes with other noise, biases and
/// scales. `before_step` is called before each run of each pass; an exception from it ends the
/// computation. Throws InputError if labels are not one per step, and if one class is missing.
[[nodiscard]] DecisionRows decision_rows(std::span<const LabelledRun> runs,
                                         const DecisionConfig& config, const DecisionFitConfig& fit,
                                         const std::function<void()>& before_step = {});

/// The offset that turns a logit fitted to these weighted rows into that of equally weighted rows:
/// ln of the weight of a row without contact relative to a row in contact.
[[nodiscard]] float weights_offset(const DecisionRows& rows);

/// Fits the network by cross-entropy with weighted classes, then removes the weights' effect from
/// the logit, so that it means the probability of contact in runs like these. The same runs and
/// configuration give the same weights. Errors: as above, and for an invalid configuration.
[[nodiscard]] DecisionModel fit_decision_model(std::span<const LabelledRun> runs,
                                               const DecisionConfig& config = {},
                                               const DecisionFitConfig& fit = {},
                                               const std::function<void()>& before_step = {});

}  // namespace touchdown
