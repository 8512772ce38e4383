#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "experiments/config/experiment.hpp"
#include "experiments/estimators/entry.hpp"
#include "experiments/fitting/fitting.hpp"
#include "experiments/run_directory/store.hpp"
#include "experiments/signals/run_signals.hpp"

namespace touchdown::experiments {

/// The hyperparameters of an estimator's trials: its defaults, then random draws within their
/// ranges. Draws depend only on the seed of fitted runs, the estimator's name and the trial's
/// number. They have three digits, so that tables contain them exactly. Empty for an estimator
/// without hyperparameters.
std::vector<HyperparameterValues> trial_hyperparameters(const EstimatorEntry& entry,
                                                        std::uint64_t seed, int trials);

/// One fold of a cross-validation over the fitted runs.
struct Fold {
  RunPointers fitted;    ///< training data: the runs of all other folds
  RunPointers held_out;  ///< validation data: the runs of this fold
};

/// Assigns runs to folds in turn, so that each scene is spread over the folds. All runs of one draw
/// of a scene are in the same fold. A scene that is not `drawn` counts as one draw.
std::vector<Fold> folds_of(std::span<const RunSignals* const> runs, std::size_t folds, bool drawn);

/// One set of hyperparameters and its score.
struct Trial {
  std::string simulator;
  std::string fit;  ///< name of the fit; empty: the experiment's own
  std::string estimator;
  int number = 0;  ///< 0: the estimator's defaults
  HyperparameterValues hyperparameters;
  /// F1 of takeoffs and landings over all runs, noise settings and wheels; 0 without any. Each run
  /// is evaluated with a fit to the other folds.
  double score = 0.0;
  bool is_chosen = false;  ///< the best of its estimator on this engine; the first of equals

  static auto members(auto& trial) {
    return std::tie(trial.simulator, trial.fit, trial.estimator, trial.number,
                    trial.hyperparameters, trial.score, trial.is_chosen);
  }
};

/// Runs the same number of trials for every estimator with hyperparameters, on each engine, in
/// parallel. Those of `TuningConfig::fixed` keep their defaults. Returns trials by engine,
/// estimator, then number. Validation runs have the sensor model and the tuning's noise.
/// Trials in the store are not repeated. Errors: `InputError` when a fold leaves too little data
/// for a fit; `Stopped`.
std::vector<Trial> tune(const Experiment& experiment, const std::string& fit,
                        const RunPointers& fit_runs, const std::function<bool()>& should_continue,
                        const Store& store = {});

/// The chosen values among the trials of one fit.
TunedHyperparameters chosen_in(const std::vector<Trial>& trials);

}  // namespace touchdown::experiments
