#include "experiments/run_experiment.hpp"

#include <chrono>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/fingerprint.hpp"
#include "core/program.hpp"
#include "experiments/evaluation/tuning_table.hpp"
#include "experiments/needs.hpp"
#include "experiments/results/long_table.hpp"
#include "experiments/results/result_files.hpp"
#include "experiments/run_directory/own_files.hpp"
#include "experiments/run_directory/test_seed_log.hpp"
#include "experiments/signals/reserved_seeds.hpp"
#include "experiments/stages.hpp"
#include "experiments/studies/experiment_file.hpp"
#include "experiments/studies/registry.hpp"

namespace touchdown::experiments {

namespace {

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

/// Errors: `Error` with the reasons if no test run can be scored.
void require_scored_run(const Rollouts& runs) {
  if (is_any_scored(runs)) return;
  std::map<std::string, std::string> endings;
  for (const auto& [index, run] : runs) {
    if (run.plan.role == RunRole::test) endings[run.plan.file] = run.report.ending;
  }
  throw Error("no test run stayed upright: there is nothing to score: " + failures_text(endings));
}

/// Scores with intervals, and the studies. Errors: `Stopped`.
ExperimentResult score(ExperimentContext& context, Computed& done) {
  const Experiment& experiment = context.request.experiment;
  const Plan& plan = context.plan;
  ExperimentResult result{
      experiment, context.request.id, context.directory, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}};
  result.models = std::move(done.models);
  result.cells = plan.groups.front().counted;
  const auto add = [&](const StudyResult& found) {
    const auto append = [](auto& all, const auto& more) {
      all.insert(all.end(), more.begin(), more.end());
    };
    append(result.studies, found.texts);
    append(result.failed_demands, found.failed_demands);
    append(result.figures, found.figures);
  };
  timed(context, "score", [&] {
    const CollectedCounts counts = collect(plan, plan.runs_in(0), context.directory.store());
    const scoring::BootstrapConfig& bootstrap = experiment.intervals.bootstrap;
    result.summaries = summarise(own(counts.counted), result.cells, bootstrap);
    const std::vector<ConditionScores> scored = own(counts.scored);
    result.scores = summarise(scored, experiment.highlights, bootstrap);
    result.differences = differences(scored, experiment.highlights, bootstrap);
    if (experiment.tuning) {
      add(summarize_tuning(done.trials, experiment, context.directory));
    }
    const Evaluation evaluation{context.request,           plan,   done.runs,
                                context.directory.store(), counts, result.models};
    for (const Study* study : requested_studies(experiment)) {
      add(study->summarize(evaluation, context.directory));
    }
  });
  return result;
}

/// Logs that a reserved seed was used, and adds a text about it.
void log_reserved_seed(ExperimentResult& result) {
  const std::uint64_t seed = result.experiment.seed;
  if (!is_reserved(seed)) return;
  const std::filesystem::path log = test_seed_log();
  const int others = log_evaluation(log, {seed, result.id, build_commit()});
  result.studies.push_back(fmt::format(
      "Seed {} is reserved for numbers that are reported once: other configurations or builds "
      "scored its runs {} times before ({})\n",
      seed, others, log.string()));
}

/// An experiment on one page, in two halves. The first: simulate → tune → fit → evaluate → model
/// tasks. Each stage reads what is saved and computes the rest, so that a resumed run, a shard and
/// a merge are the same calls. Without streamed runs all tasks are evaluated after the last fit;
/// with them, tasks are evaluated as soon as their fits are there, so that memory need not hold all
/// models. Errors: `Stopped`, with what is saved.
Computed compute(ExperimentContext& context, const TaskRange& tasks, MissingRun missing) try {
  const NeededRuns needed = needed_runs(context, tasks);
  Computed done;
  timed(context, "simulate", [&] { done.runs = hold_rollouts(context, needed.held, missing); });
  PendingTasks pending(context.plan, tasks);
  const NeededFits fits = needed_fits(context, needed, done.runs);
  for (const std::string& engine : fits.engines) {
    for (const std::string& fit : fits.names) {
      timed(context, "fit", [&] { tune_and_fit(context, needed, engine, fit, missing, done); });
      if (needed.streamed.empty()) continue;
      const std::vector<std::size_t> ready = pending.take_ready(done.models);
      timed(context, "evaluate", [&] { evaluate(context, needed, ready, missing, done); });
      release_phase_models(context, pending, tasks, done.models);
    }
  }
  if (!fits.engines.empty()) {
    timed(context, "fit", [&] { fit_training_sets(context, fits, done); });
    if (!context.should_continue()) throw Stopped();
  }
  const std::vector<std::size_t> left = pending.take_all();
  timed(context, "evaluate", [&] { evaluate(context, needed, left, missing, done); });
  if (has_model_tasks(context.plan, tasks)) {
    timed(context, "model_tasks", [&] {
      run_model_tasks(context.plan, tasks, done.models, context.directory.store(), missing,
                      context.should_continue);
    });
  }
  return done;
} catch (const Stopped&) {
  throw Stopped(what_is_saved(context));
}

/// The second half of an experiment: score → studies → tables and models; pictures are drawn from
/// the result (render/pictures/pictures.hpp). It evaluates no estimator. Errors: `Stopped`, with
/// what is saved; `Error` with the reasons if no test run can be scored.
ExperimentResult summarize(ExperimentContext& context, Computed done) try {
  require_scored_run(done.runs);
  ExperimentResult result = score(context, done);
  log_reserved_seed(result);
  for (auto& [index, run] : done.runs) {
    if (run.plan.group == 0) result.runs.push_back(std::move(run));
  }
  release_free_memory();  // of the studies' tables
  result.provenance = context.provenance;
  write_result_files(result);
  write_results(context.request, context.directory);
  remove_shard_marks(context.directory.path());
  remove_partial_files(context.directory.path());
  write_manifest(result);
  return result;
} catch (const Stopped&) {
  throw Stopped(what_is_saved(context));
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
  outline.memory = least_memory(request, 1.0);
  outline.disk = disk_needs(plan).all();
  return outline;
}

ExperimentResult run_experiment(const Experiment& experiment, const RunOptions& options) {
  RunRequest request = request_of(experiment);
  require_memory(request, 1.0);
  Plan plan = whole_plan(request);  // a request that is refused makes no directory
  RunDirectory directory = open_run_directory(request, Access::alone, options);
  remove_partial_files(directory.path());
  ExperimentContext context =
      start(std::move(request), std::move(plan), std::move(directory), options);
  return summarize(context, compute(context, context.plan.all_tasks(), MissingRun::simulate));
}

ShardReport run_shard(const Experiment& experiment, const Shard& shard, const RunOptions& options) {
  RunRequest request = request_of(experiment);
  require_memory(request, 1.0 / shard.count);
  Plan plan = whole_plan(request);
  RunDirectory directory = open_run_directory(request, Access::shared, options);
  mark_shard_started(directory.path(), shard);
  ExperimentContext context =
      start(std::move(request), std::move(plan), std::move(directory), options);
  const std::size_t all = context.plan.tasks.size();
  const TaskRange tasks{shard.begin(all), shard.end(all)};
  ShardReport report{context.directory, tasks.size(), 0, {}};
  if (tasks.size() == 0) return report;
  const Computed done = compute(context, tasks, MissingRun::simulate);
  report.computed = done.tasks;
  for (const auto& [index, run] : done.runs) {
    if (run.failed()) report.failed_runs.push_back(run);
  }
  return report;
}

ExperimentResult merge_run(const std::filesystem::path& path, const RunOptions& options) {
  require_no_links(path);
  std::optional<DirectoryLock> lock;
  if (owner_of(path)) lock.emplace(path, Access::alone, options.command);
  RunRequest request = read_request(path);  // throws if no run owns the directory
  require_memory(request, 1.0);
  RunDirectory directory(request.experiment.name, request.id, path);
  directory.keep(*lock);
  ExperimentContext context = start(std::move(request), std::move(directory), options);
  require_all_shards(context);
  return summarize(context, compute(context, context.plan.all_tasks(), MissingRun::refuse));
}

}  // namespace touchdown::experiments
