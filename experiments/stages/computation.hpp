#pragma once

#include <cstddef>

#include "experiments/plan/plan.hpp"
#include "experiments/rollouts/rollouts.hpp"
#include "experiments/stages/experiment_context.hpp"
#include "experiments/stages/fits.hpp"

namespace touchdown::experiments {

struct Computed {
  Rollouts runs;
  Fitted fitted;
  std::size_t tasks = 0;  ///< tasks that were not saved already
};

/// The first half of an experiment: simulate → fit → evaluate → model tasks. Saved results are
/// read, not computed again. Errors: `Stopped`, with what is saved, if the user stopped the
/// experiment.
Computed compute(ExperimentContext& context, const TaskRange& tasks, MissingRun missing);

}  // namespace touchdown::experiments
