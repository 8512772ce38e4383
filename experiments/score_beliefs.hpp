#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/experiment_context.hpp"

namespace touchdown::experiments {

/// Beliefs about a benchmark's runs, of an estimator that is none of ours.
struct BeliefRequest {
  std::filesystem::path run;      ///< run directory of a finished benchmark
  std::filesystem::path beliefs;  ///< a folder, or a file about one run
  std::string name;               ///< of the estimator; empty: the folder's or the file's
};

struct BeliefReport {
  std::string name;
  std::size_t scored = 0;            ///< runs through a noise setting
  std::vector<std::string> without;  ///< files that were not handed in, by their names in an export
  std::size_t about_fitted = 0;      ///< files about fitted runs, which are not scored
  std::size_t about_failed = 0;      ///< files about runs that failed, likewise
  std::size_t missing_steps = 0;     ///< at which the last belief stands
  std::size_t files_with_missing = 0;
  std::string table;  ///< the benchmark, for people
};

/// Scores them as ours are scored, keeps that in the run directory, and writes its
/// `tables/benchmark.csv` again. Errors: `InputError` for what is no finished benchmark, a name
/// that is taken, and beliefs that are wrong; `Stopped`, and then nothing has changed.
BeliefReport score_beliefs(const BeliefRequest& request, const RunOptions& options);

}  // namespace touchdown::experiments
