#include "experiments/run_experiment.hpp"

#include <chrono>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "core/machine.hpp"
#include "core/progress.hpp"
#include "experiments/config/experiment_yaml.hpp"
#include "experiments/run_directory/own_files.hpp"
#include "experiments/stages.hpp"

namespace touchdown::experiments {

namespace {

/// The class of the processor of each shard, because those of other classes compute other last
/// digits.
constexpr std::string_view processor_parts = "processors";

/// Locks the request's run directory for this process, and writes the request if it is not there.
RunDirectory open_run_directory(const RunRequest& request, Access access,
                                const RunOptions& options) {
  const std::string& name = request.experiment.name;
  require_place(request, run_path(name, request.id, options.out), options.overwrite);
  RunDirectory directory(name, request.id, options.out);
  const std::filesystem::path& path = directory.path();
  if (access == Access::alone) {
    directory.keep({path, access, options.command});
    write_request(request, directory, options.overwrite);
    return directory;
  }
  // Shards that start together wait for the first of them to write the request.
  constexpr std::chrono::seconds patience(10);
  directory.keep({path, access, options.command, patience});
  if (is_written(request, path)) return directory;
  directory.release();
  directory.keep({path, Access::alone, options.command, patience});
  if (!is_written(request, path)) write_request(request, directory, options.overwrite);
  directory.release();
  directory.keep({path, access, options.command, patience});
  require_place(request, path, false);
  return directory;
}

/// An experiment on one page. Each stage reads what is saved and computes the rest, so that a
/// resumed run and a shard are the same calls. A shard ends when its tasks are evaluated,
/// without a result. Pictures are drawn from the result (render/report/report.hpp). Errors:
/// `Stopped`, with what is saved; `Error` with the reasons if no test run can be scored.
std::optional<ExperimentResult> run_stages(ExperimentContext& context, Computed& done) try {
  fit(context, done);
  evaluate(context, done);
  run_model_tasks(context, done);
  if (done.is_shard) return std::nullopt;

  require_scored_run(done.runs);
  ExperimentResult result = score(context, done);
  log_reserved_seed(result);
  write_result(context, done, result);
  return result;
} catch (const Stopped&) {
  throw Stopped(what_is_saved(context));
}

ExperimentResult whole(ExperimentContext& context) {
  Computed done{context.plan.all_tasks()};
  return *run_stages(context, done);
}

/// A message if shards ran on processors of different classes.
void compare_processors(const RunDirectory& directory) {
  std::set<std::string> processors;
  for (const std::string& shard : directory.store().names(processor_parts)) {
    const auto processor = directory.store().find<std::string>(processor_parts, shard);
    if (processor) processors.insert(*processor);
  }
  if (processors.size() < 2) return;
  print_message(fmt::format(
      "touchdown: {}: its shards ran on different processors ({}), so that last digits, and runs "
      "that these decide, differ from those of one machine\n",
      directory.path().string(), fmt::join(processors, "; ")));
}

}  // namespace

RunOutline outline_of(const Experiment& experiment, const RunOptions& options) {
  const RunRequest request = request_of(experiment);
  const std::filesystem::path directory = run_path(experiment.name, request.id, options.out);
  require_place(request, directory, options.overwrite);
  const Plan plan = whole_plan(request);
  RunOutline outline;
  outline.directory = directory;
  outline.tasks = plan.tasks.size();
  std::set<std::string> simulations;  // runs that differ only in their sensors share one
  for (const PlannedRun& run : plan.runs) {
    ++(run.role == RunRole::fit ? outline.fitted_runs : outline.test_runs);
    if (!simulations.insert(simulation_key(run)).second) continue;
    outline.simulated += run.scenario.end.duration;
  }
  for (const ModelTasks& tasks : plan.model_tasks) {
    outline.model_tasks.emplace_back(tasks.name, fmt::format("{} {}s", tasks.count, tasks.unit));
  }
  return outline;
}

ExperimentResult run_experiment(const Experiment& experiment, const RunOptions& options) {
  RunRequest request = request_of(experiment);
  Plan plan = whole_plan(request);  // a request that is refused makes no directory
  RunDirectory directory = open_run_directory(request, Access::alone, options);
  remove_partial_files(directory.path());
  ExperimentContext context =
      start(std::move(request), std::move(plan), std::move(directory), options);
  return whole(context);
}

ShardReport run_shard(const Experiment& experiment, const Shard& shard, const RunOptions& options) {
  RunRequest request = request_of(experiment);
  Plan plan = whole_plan(request);
  RunDirectory directory = open_run_directory(request, Access::shared, options);
  directory.store().put(processor_parts, fmt::format("{}_of_{}", shard.index, shard.count),
                        processor_class());
  ExperimentContext context =
      start(std::move(request), std::move(plan), std::move(directory), options);
  const std::size_t all = context.plan.tasks.size();
  const TaskRange tasks{shard.begin(all), shard.end(all)};
  ShardReport report{context.directory, tasks.size(), 0, {}};
  if (tasks.size() == 0) return report;
  Computed done{tasks, true};
  (void)run_stages(context, done);
  report.computed = done.tasks;
  for (const auto& [index, run] : done.runs) {
    if (run.failed()) report.failed_runs.push_back(run);
  }
  return report;
}

ExperimentResult finish_run(const std::filesystem::path& path, const RunOptions& options) {
  ExperimentContext context = reopened(path, options);
  compare_processors(context.directory);
  return whole(context);
}

}  // namespace touchdown::experiments
