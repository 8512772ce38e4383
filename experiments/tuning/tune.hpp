#pragma once

#include <functional>
#include <string>
#include <vector>

#include "experiments/config/experiment.hpp"
#include "experiments/fitting/fitting.hpp"
#include "experiments/signals/run_signals.hpp"
#include "experiments/tuning/saved.hpp"

namespace touchdown::experiments {

/// One set of hyperparameters and its score.
struct Trial {
  std::string simulator;
  std::string fit;  ///< name of the fit; empty: the experiment's own
  std::string estimator;
  int number = 0;  ///< 0: the estimator's defaults
  HyperparameterValues hyperparameters;
  /// Balanced accuracy, mean over scenes and noise settings, with both wheels and all runs of a
  /// scene pooled. Each run is evaluated with a fit to the other folds.
  double score = 0.0;
  bool is_chosen = false;  ///< the best of its estimator on this engine; the first of equals
};

/// Runs the same number of trials for every estimator with hyperparameters, on each engine, in
/// parallel. Those of `TuningConfig::fixed` and reference upper bounds, which are not ranked, keep
/// their defaults. Returns trials by engine, estimator, then number. Whole runs and segments serve
/// as training data, whole runs as validation data, with the sensor model and the tuning's noise.
/// Saved trials are not repeated. Errors: `InputError` when a fold leaves too little data for a
/// fit; `Stopped`.
std::vector<Trial> tune(const Experiment& experiment, const std::string& fit,
                        const RunPointers& fit_runs, const RunPointers& segments,
                        const std::function<bool()>& should_continue,
                        const SavedTrials& saved = {});

/// The chosen values among the trials of one fit.
TunedHyperparameters chosen_in(const std::vector<Trial>& trials);

}  // namespace touchdown::experiments
