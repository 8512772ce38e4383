#pragma once

#include <functional>

#include "estimator/decision/config.hpp"
#include "estimator/decision/descent.hpp"
#include "estimator/decision/network.hpp"

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

}  // namespace touchdown
