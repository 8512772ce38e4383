#pragma once

#include <span>

#include "estimator/force/load_logistic.hpp"
#include "estimator/labelled_run.hpp"

namespace touchdown {

/// Fits the curve of `LoadLogistic` to all steps of both wheels of all runs that have a force, each
/// run at its own rate. Errors: `InputError` for steps of one class only, and for labels that are
/// not one per step.
[[nodiscard]] LogisticCurve fit_load_logistic(std::span<const LabelledRun> runs,
                                              const LoadLogisticConfig& config = {});

}  // namespace touchdown
