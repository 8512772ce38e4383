#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/run_directory/shard.hpp"
#include "experiments/experiment_context.hpp"

namespace touchdown::experiments {

/// What running an experiment would amount to.
struct RunOutline {
  std::filesystem::path directory;  ///< where its results go
  std::size_t tasks = 0;            ///< parts that can be computed apart from each other
};

/// Checks an experiment and its scenarios; nothing is computed or written.
/// Errors: `InputError` for a wrong request.
RunOutline outline_of(const Experiment& experiment, const RunOptions& options);

/// Simulates, fits, listens, scores and writes tables. What an earlier attempt of the same program,
/// whole or in shards, left complete in the run directory is used and not computed again.
/// Errors: `InputError` for a wrong request; `Stopped`, saying what is saved; `Error` when no run
/// can be scored.
ExperimentResult run_experiment(const Experiment& experiment, const RunOptions& options);

/// What one shard did.
struct ShardReport {
  RunDirectory directory;
  std::size_t tasks = 0;     ///< of the shard
  std::size_t computed = 0;  ///< of these; the others were there already
  std::vector<Rollout> failed_runs;
};

/// Computes one shard of an experiment: the recordings that it needs and its share of the
/// listening, as files in the run directory, which other shards may be writing to at the same time,
/// also from other machines. Errors: as above.
ShardReport run_shard(const Experiment& experiment, const Shard& shard, const RunOptions& options);

/// Puts together what shards left in a run directory: the result and the files are those of
/// `run_experiment`, to the byte. Simulates and listens to nothing.
/// Errors: `InputError` when there is no run, when it is another build's, or naming the shards that
/// are not finished.
ExperimentResult merge_run(const std::filesystem::path& directory, const RunOptions& options);

}  // namespace touchdown::experiments
