#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "experiments/experiment_context.hpp"
#include "experiments/run_directory/shard.hpp"

namespace touchdown::experiments {

/// What a run of an experiment would compute.
struct RunOutline {
  std::filesystem::path directory;  ///< of its results
  std::size_t tasks = 0;  ///< parts of the evaluation, which are independent of each other
  std::size_t fitted_runs = 0;
  std::size_t test_runs = 0;
  double simulated = 0.0;  ///< duration of all simulations, if none ends early (s)
  std::vector<std::pair<std::string, std::string>> model_tasks;  ///< name, and number with unit
};

/// Checks an experiment and its scenarios, and counts what it would compute. Simulates and writes
/// nothing. Errors: `InputError` for a wrong request.
RunOutline outline_of(const Experiment& experiment, const RunOptions& options);

/// Simulates, fits, evaluates, scores and writes tables. It reuses the complete results of an
/// earlier attempt of the same program in the run directory, whole or in shards.
/// Errors: `InputError` for a wrong request; `Stopped` with what is saved; `Error` when no run can
/// be scored.
ExperimentResult run_experiment(const Experiment& experiment, const RunOptions& options);

/// What one shard computed.
struct ShardReport {
  RunDirectory directory;
  std::size_t tasks = 0;     ///< of the shard
  std::size_t computed = 0;  ///< of these; the others were saved before
  std::vector<FinishedRun> failed_runs;
};

/// Computes one shard of an experiment: the recordings that it needs and its share of the
/// evaluation, as files in the run directory. Other shards may write there at the same time, also
/// from other machines. Errors: as above.
ShardReport run_shard(const Experiment& experiment, const Shard& shard, const RunOptions& options);

/// Computes what a run directory lacks, such as the results after its last shard. The result and
/// the files equal those of `run_experiment` to the byte. A message names different processors of
/// shards. Errors: `InputError` when there is no run, or when another build computed it; as above.
ExperimentResult finish_run(const std::filesystem::path& directory, const RunOptions& options);

}  // namespace touchdown::experiments
