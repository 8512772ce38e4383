#pragma once

#include <functional>
#include <string>
#include <vector>

#include "experiments/config/experiment.hpp"
#include "experiments/fitting/fitting.hpp"
#include "experiments/signals/run_signals.hpp"
#include "experiments/tuning/saved.hpp"

namespace touchdown::experiments {

/// One set of constants that an estimator was tried with.
struct Trial {
  std::string simulator;
  std::string fit;  ///< the name of the fit; empty: the experiment's own
  std::string estimator;
  int number = 0;  ///< 0: its defaults
  HyperparameterValues hyperparameters;
  /// Mean over scenes and noise settings of the balanced accuracy, both wheels and all runs of a
  /// scene added, each run heard by an estimator that was fitted to runs of other folds.
  double score = 0.0;
  bool is_chosen = false;  ///< the best of its estimator in this engine; of equals the first
};

/// As many trials of every estimator that has something to choose, on each engine, in parallel: by
/// engine, estimator, then number. Only these runs decide: whole ones and pieces are fitted to,
/// whole ones are judged, as sensors report them and through the tuning's noise. What is saved is
/// not tried again. Errors: `InputError` where too few are left to fit to, `Stopped`.
std::vector<Trial> tune(const Experiment& experiment, const std::string& fit,
                        const std::vector<RunSignals>& fit_runs,
                        const std::vector<RunSignals>& segments,
                        const std::function<bool()>& should_continue, const SavedTrials& saved = {});

/// What was chosen, of the trials of one fit.
TunedHyperparameters chosen_in(const std::vector<Trial>& trials);

}  // namespace touchdown::experiments
