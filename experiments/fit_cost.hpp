#pragma once

#include <string>
#include <vector>

#include "experiments/config/experiment.hpp"
#include "experiments/fitting/fitting.hpp"
#include "experiments/rollouts/rollouts.hpp"

namespace touchdown::experiments {

/// The cost of an estimator's fit by its data: fixed + per_second × seconds of data.
struct FitCost {
  std::string estimator;
  double fixed = 0.0;       ///< processor time (s)
  double per_second = 0.0;  ///< processor time per second of data
  double memory = 0.0;      ///< working memory of one fit (bytes)
  int passes = 0;           ///< over the data, of a fit that draws a fixed number of rows
  /// Whether a hyperparameter of tuning changes the fit.
  bool is_tuned = false;
  bool is_upper_bound = false;

  [[nodiscard]] double of(double seconds) const { return fixed + per_second * seconds; }
};

/// Small fits of the first engine, and their costs. Estimators that share a fit count once.
struct FitSample {
  FittedModels models;
  std::vector<FitCost> costs;
  std::vector<std::string> unmeasured = {};  ///< estimators with fits that need more data

  /// Processor time of all fits to so much data (s), and of its part that refits repeat.
  [[nodiscard]] double of(double seconds) const;
  [[nodiscard]] double of_refit(double seconds) const;
  /// The most working memory of so many fits at once (bytes).
  [[nodiscard]] double memory(int at_once) const;
};

/// Runs that a small fit uses.
inline constexpr std::size_t most_fitted_runs = 6;

/// Fits every estimator to a few seconds of simulated fitted runs of the experiment's own fit.
/// Errors: `Stopped`.
FitSample sample_fits(const Experiment& experiment, const Rollouts& runs,
                      const ShouldContinue& should_continue);

/// The first `seconds` of a run.
RunSignals beginning_of(const RunSignals& run, double seconds);

}  // namespace touchdown::experiments
