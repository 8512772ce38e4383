#pragma once

#include "core/table.hpp"
#include "experiments/evaluation/tasks.hpp"

namespace touchdown::experiments {

/// Measures decisions against other definitions of contact: force thresholds of 0.1, 1, 5 and 10 N,
/// each with debounces of 0, 2, 5 and 10 ms. Estimators stay as fitted, only the truth changes. It
/// measures in-domain predictions at the first highlighted noise setting with the first noise
/// realisation; a score is of type `scoring::Classification`, both wheels added.
Measure label_measure();

/// Point-wise scores, a row per engine, estimator and definition, with intervals over runs.
Table label_table(const Evaluation& evaluation);

}  // namespace touchdown::experiments
