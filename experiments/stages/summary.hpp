#pragma once

#include "experiments/results/result.hpp"
#include "experiments/stages/computation.hpp"
#include "experiments/stages/experiment_context.hpp"

namespace touchdown::experiments {

/// The second half of an experiment: score → tables. It evaluates no estimator. Errors:
/// `Stopped`; `Error` with the reasons if no test run can be scored.
ExperimentResult summarize(ExperimentContext& context, Computed done);

}  // namespace touchdown::experiments
