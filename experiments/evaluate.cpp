#include <atomic>
#include <map>
#include <mutex>
#include <set>

#include <fmt/format.h>
#include <tbb/parallel_for_each.h>
#include <tbb/task_arena.h>

#include "core/error.hpp"
#include "core/program.hpp"
#include "core/progress.hpp"
#include "experiments/stages.hpp"

namespace touchdown::experiments {

namespace {

/// The tasks of a share by their runs.
std::map<std::size_t, std::vector<const Task*>> tasks_by_run(const Plan& plan,
                                                             const TaskRange& share) {
  std::map<std::size_t, std::vector<const Task*>> tasks;
  for (std::size_t t = share.begin; t < share.end; ++t) {
    tasks[plan.tasks[t].run].push_back(&plan.tasks[t]);
  }
  return tasks;
}

/// How a run ended, if all of its tasks and its recording are saved.
std::optional<RunReport> saved_report(const ExperimentContext& context, std::size_t run,
                                      const std::vector<const Task*>& tasks) {
  if (!is_recorded(context.plan.runs[run], context.directory)) return std::nullopt;
  std::optional<RunReport> report;
  for (const Task* task : tasks) {
    std::optional<TaskCounts> counts = saved_counts(context.plan, *task, context.directory.store());
    if (!counts) return std::nullopt;
    report = std::move(counts->report);
  }
  return report;
}

}  // namespace

void evaluate(ExperimentContext& context, Computed& done) {
  const StageTimer timer(context, "evaluate");
  const Plan& plan = context.plan;
  const Experiment& experiment = context.request.experiment;
  const auto tasks = tasks_by_run(plan, done.share);
  std::set<std::size_t> missing;
  for (const auto& [run, of_run] : tasks) {
    if (!context.should_continue()) throw Stopped();
    std::optional<RunReport> report = saved_report(context, run, of_run);
    if (report) {
      done.runs.emplace(run, FinishedRun{plan.runs[run], *std::move(report)});
    } else {
      missing.insert(run);
    }
  }
  const std::size_t saved = tasks.size() - missing.size();
  if (saved > 0) {
    print_message(fmt::format("{} of {} runs were evaluated before\n", saved, tasks.size()));
  }
  if (missing.empty()) return;
  std::atomic<std::size_t> computed = 0;
  std::mutex mutex;
  const auto evaluate_run = [&](std::size_t index, Rollout run) {
    NoiseFreeScores noise_free;
    // A thread that waits for the other noise seeds must not begin another run meanwhile: memory
    // holds one run per thread.
    tbb::this_task_arena::isolate([&] {
      tbb::parallel_for_each(tasks.at(index), [&](const Task* task) {
        if (!context.should_continue()) throw Stopped();
        const bool is_new =
            evaluate_and_save(plan, *task, run, experiment, done.models, context.directory.store(),
                              noise_free, context.should_continue);
        if (is_new) ++computed;
      });
    });
    {
      const std::lock_guard lock(mutex);
      done.runs.emplace(index, FinishedRun{run.plan, run.report});
    }
    run.signals = {};
    release_free_memory();  // the pieces of ever new sizes that runs leave
  };
  for_each_rollout("evaluating", experiment, plan, missing, context.directory, MissingRun::simulate,
                   context.should_continue, evaluate_run);
  done.tasks += computed;
}

void run_model_tasks(ExperimentContext& context, const Computed& done) {
  if (!has_model_tasks(context.plan, done.share)) return;
  const StageTimer timer(context, "model_tasks");
  run_model_tasks(context.plan, done.share, done.models, context.directory.store(),
                  context.should_continue);
}

StageTimer::~StageTimer() {
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  auto& timings = context_.provenance.timings;
  auto same = std::ranges::find(timings, stage_, &std::pair<std::string, double>::first);
  if (same == timings.end()) same = timings.insert(same, {stage_, 0.0});
  same->second += elapsed.count();
}

}  // namespace touchdown::experiments
