#pragma once

#include <functional>

#include "estimator/decision/config.hpp"
#include "estimator/decision/descent.hpp"
#include "estimator/decision/network.hpp"

namespace touchdown {

/// The weighted mean of the cross-entropy of these rows, and its gradient where one is asked for.
[[nodiscard]] double decision_loss(const DecisionModel& model, const DecisionRows& rows,
                                   DecisionModel* gradient = nullptr);

/// Weights drawn by He's rule, then Adam with decoupled decay over batches that are drawn with
/// replacement, for as many steps as the configured epochs have. The same rows and seed give the
/// same weights. `before_step` is called now and then: what it throws ends the training.
[[nodiscard]] DecisionModel train_decision_model(const DecisionRows& rows,
                                                 const DecisionFitConfig& config,
                                                 const std::function<void()>& before_step = {});

}  // namespace touchdown
