#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/experiment.hpp"
#include "experiments/fitting.hpp"
#include "experiments/manifest.hpp"
#include "experiments/metrics.hpp"
#include "experiments/run_directory.hpp"
#include "experiments/run_plan.hpp"
#include "experiments/shard.hpp"
#include "experiments/success_tables.hpp"

namespace touchdown {

/// How an experiment is run; none of it changes a result.
struct RunOptions {
  std::filesystem::path out;                ///< run directory; empty: by the experiment's content
  std::string command;                      ///< what was typed, for the manifest
  const std::atomic<bool>* stop = nullptr;  ///< becomes true when the user asks to stop
};

/// What an experiment found out. The same is in the run directory's files.
struct ExperimentResult {
  Experiment experiment;
  std::string id;
  RunDirectory directory;
  std::vector<PlayedRun> runs;
  FittedModels models;
  std::vector<NoiseCell> cells;
  std::vector<CellSummary> summaries;   ///< of every noise cell
  std::vector<ScoreSummary> scores;     ///< of the highlighted ones
  std::vector<Difference> differences;  ///< likewise
  Provenance provenance;
};

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
  std::vector<PlayedRun> failed_runs;
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

/// The test runs that are scored: all but those that fell or diverged.
std::vector<const HeardRun*> scored_runs(const std::vector<PlayedRun>& runs);

/// Writes `manifest.json`; again when there are more timings to tell.
void write_manifest(const ExperimentResult& result);

}  // namespace touchdown
