#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/experiment_context.hpp"
#include "experiments/signals/run_signals.hpp"
#include "logs/log/beliefs.hpp"
#include "scoring/score.hpp"

namespace touchdown::experiments {

/// A submitted estimator's beliefs about the runs of a benchmark.
struct BeliefRequest {
  std::filesystem::path run;      ///< run directory of a finished benchmark
  std::filesystem::path beliefs;  ///< a folder of files, or the file of one run
  std::string name;               ///< of the estimator; empty: the name of the folder or file
};

struct BeliefReport {
  std::string name;
  std::size_t scored = 0;            ///< pairs of a run and a noise setting
  std::vector<std::string> without;  ///< missing files, by their names in an export
  std::size_t about_fitted = 0;      ///< files of fitted runs, which are not scored
  std::size_t about_failed = 0;      ///< files of failed runs, which are not scored
  std::size_t missing_steps = 0;     ///< steps without a belief, which keep the last one
  std::size_t files_with_missing = 0;
  std::string table;  ///< the benchmark's table, as text
};

/// Scores submitted beliefs like the project's own estimators. Saves the scores in the run
/// directory and writes its `tables/benchmark.csv` again. Errors: `InputError` for a directory
/// without a finished benchmark, a name that is taken, or wrong beliefs; `Stopped`, with nothing
/// changed.
BeliefReport score_beliefs(const BeliefRequest& request, const RunOptions& options);

/// The submitted contact at every step of a run.
struct SubmittedPrediction {
  scoring::Prediction prediction;
  std::size_t without = 0;  ///< steps with a record but without a belief
};

/// Each belief holds from the step nearest to its time until the next belief; before the first,
/// p = 0.5. P(any wheel in contact) and P(both wheels in contact) follow from independent wheels.
/// Errors: `InputError` for a time outside of the run, or two beliefs at one step.
SubmittedPrediction prediction_of(const logs::Beliefs& beliefs, const RunSignals& run);

}  // namespace touchdown::experiments
