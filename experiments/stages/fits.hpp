#pragma once

#include <set>
#include <string>
#include <vector>

#include "experiments/fitting/fitting.hpp"
#include "experiments/rollouts/rollouts.hpp"
#include "experiments/stages/experiment_context.hpp"
#include "experiments/tuning/tune.hpp"

namespace touchdown::experiments {

/// The fitted models, and the tuning trials before the fit.
struct Fitted {
  FittedModels models;
  std::vector<Trial> trials;
};

/// The engines and the names of the fits that the evaluation of these runs needs, both in the order
/// of the plan; none if no run can be scored.
struct NeededFits {
  std::vector<std::string> engines;
  std::vector<std::string> names;
};

/// `streamed` are the runs that are simulated when they are needed; `runs` are the others.
NeededFits needed_fits(const ExperimentContext& context, const std::set<std::size_t>& streamed,
                       const Rollouts& runs);

/// Runs one of the experiment's fits on its engines, with its refits. It uses the hyperparameters
/// in `chosen` unless the fit has a tuning of its own.
Fitted fit_on(const Experiment& experiment, const Rollouts& runs, const std::string& name,
              int refits, const ShouldContinue& should_continue, const SavedTrials& saved,
              TunedHyperparameters chosen);

/// The fits to the plan's training sets, each with its refits, for every engine. Errors:
/// `InputError`, with the size of the set, when one does not suffice for a fit.
FittedModels fit_training_sets(const Experiment& experiment, const ExperimentContext& context,
                               const Rollouts& runs, const TunedHyperparameters& chosen);

}  // namespace touchdown::experiments
