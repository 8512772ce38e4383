#include "experiments/run_experiment.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "experiments/execution.hpp"
#include "experiments/run_request.hpp"
#include "experiments/saved_state.hpp"
#include "experiments/shard_log.hpp"

namespace touchdown {

std::vector<const HeardRun*> scored_runs(const std::vector<PlayedRun>& runs) {
  std::vector<const HeardRun*> scored;
  for (const PlayedRun& run : runs) {
    if (run.plan.role == RunRole::test && !is_failure(run.report.outcome)) {
      scored.push_back(&run.heard);
    }
  }
  return scored;
}

RunOutline outline_of(const Experiment& experiment, const RunOptions& options) {
  const RunRequest request = request_of(experiment);
  const auto plan = plan_runs(request.experiment, request.scenarios);
  return {run_path(experiment.name, request.id, options.out),
          listening_tasks(request.experiment, plan).size()};
}

ExperimentResult run_experiment(const Experiment& experiment, const RunOptions& options) {
  RunRequest request = request_of(experiment);
  RunDirectory directory(experiment.name, request.id, options.out);
  write_request(request, directory, true);
  remove_partial_files(directory.path());
  Execution execution(std::move(request), std::move(directory), options);
  execution.compute(0, execution.tasks().size());
  return execution.assemble(options.command);
}

ShardReport run_shard(const Experiment& experiment, const Shard& shard, const RunOptions& options) {
  RunRequest request = request_of(experiment);
  RunDirectory directory(experiment.name, request.id, options.out);
  write_request(request, directory, false);
  note_shard(directory.path(), shard);
  Execution execution(std::move(request), std::move(directory), options);
  const std::size_t begin = shard.begin(execution.tasks().size());
  const std::size_t end = shard.end(execution.tasks().size());
  ShardReport report{execution.directory(), end - begin, 0, {}};
  if (begin == end) return report;
  report.computed = execution.compute(begin, end);
  for (const PlayedRun& run : execution.runs()) {
    if (is_failure(run.report.outcome)) report.failed_runs.push_back(run);
  }
  return report;
}

ExperimentResult merge_run(const std::filesystem::path& directory, const RunOptions& options) {
  RunRequest request = read_request(directory);
  const std::string name = request.experiment.name;
  const std::string id = request.id;
  Execution execution(std::move(request), RunDirectory(name, id, directory), options);
  const std::vector<std::size_t> missing = execution.missing_tasks();
  if (!missing.empty()) {
    const int count = noted_shards(directory);
    std::vector<std::string> shards;
    for (int index = 1; index <= count; ++index) {
      const Shard shard{index, count};
      const auto first =
          std::lower_bound(missing.begin(), missing.end(), shard.begin(execution.tasks().size()));
      if (first == missing.end() || *first >= shard.end(execution.tasks().size())) continue;
      shards.push_back(to_text(shard));
    }
    throw InputError(fmt::format(
        "{}: {} of {} parts are missing: finish shard{} {} first, by 'touchdown run {} --out {} "
        "--shard {}'",
        directory.string(), missing.size(), execution.tasks().size(), shards.size() == 1 ? "" : "s",
        fmt::join(shards, ", "), (directory / "config.yaml").string(), directory.string(),
        shards.front()));
  }
  return execution.assemble(options.command);
}

void write_manifest(const ExperimentResult& result) {
  write_atomically(result.directory.path() / "manifest.json",
                   manifest(result.experiment, result.id, result.runs, result.provenance));
}

}  // namespace touchdown
