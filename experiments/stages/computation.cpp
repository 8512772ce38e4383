#include "experiments/stages/computation.hpp"

#include <algorithm>
#include <atomic>
#include <iterator>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "experiments/results/result_files.hpp"
#include "experiments/rollouts/training_segments.hpp"
#include "experiments/stages/fit_run_check.hpp"
#include "experiments/stages/pending_tasks.hpp"
#include "experiments/stages/process_memory.hpp"

namespace touchdown::experiments {

namespace {

/// Keeps of a run what tables need, and frees its signals.
void drop_signals(Rollout& run) {
  RunSignals left;
  left.info = std::move(run.signals.info);
  run.signals = std::move(left);
}

/// Simulates runs and holds them. Those for training segments hold only their segments. Errors:
/// those of `FitRunCheck`.
Rollouts hold_rollouts(const ExperimentContext& context, const std::set<std::size_t>& wanted,
                       MissingRun missing) {
  const Experiment& experiment = context.request.experiment;
  Rollouts runs;
  for (const std::size_t index : wanted) {
    runs.emplace(index, Rollout{context.plan.runs[index], {}, {}});
  }
  FitRunCheck check(experiment, context.plan, wanted);
  SegmentCutter segments(experiment.training_segments, runs);
  for_each_rollout(experiment, context.plan, wanted, context.directory, missing,
                   context.should_continue, [&](std::size_t index, Rollout run) {
                     check.add(run);
                     runs.at(index) = std::move(run);
                     segments.add(index);
                     release_free_memory();  // of what is cut off
                   });
  return runs;
}

/// Simulates the streamed runs of one fit on one engine.
Rollouts simulate_fit(const ExperimentContext& context, const std::set<std::size_t>& streamed,
                      const std::string& name, const std::string& simulator, MissingRun missing) {
  std::set<std::size_t> wanted;
  for (const std::size_t index : streamed) {
    const PlannedRun& run = context.plan.runs[index];
    if (run.role == RunRole::fit && run.fit == name && run.simulator == simulator) {
      wanted.insert(index);
    }
  }
  return wanted.empty() ? Rollouts() : hold_rollouts(context, wanted, missing);
}

/// Simulates the streamed test runs of these tasks, and evaluates each at once; its report goes to
/// `runs`. Returns the number of tasks that were not saved.
std::size_t evaluate_streamed(const ExperimentContext& context,
                              const std::set<std::size_t>& streamed,
                              std::span<const std::size_t> tasks, const FittedModels& models,
                              MissingRun missing, Rollouts& runs) {
  const Plan& plan = context.plan;
  const Experiment& experiment = context.request.experiment;
  std::map<std::size_t, std::vector<const Task*>> tasks_of;
  std::set<std::size_t> tests;
  for (const std::size_t t : tasks) {
    const std::size_t index = plan.tasks[t].run;
    if (!streamed.contains(index)) continue;
    tasks_of[index].push_back(&plan.tasks[t]);
    tests.insert(index);
    runs.emplace(index, Rollout{plan.runs[index], {}, {}});
  }
  std::atomic<std::size_t> computed = 0;
  if (tests.empty()) return computed;
  for_each_rollout(experiment, plan, tests, context.directory, missing, context.should_continue,
                   [&](std::size_t index, Rollout run) {
                     NoiseFreeScores noise_free;
                     for (const Task* task : tasks_of.at(index)) {
                       computed +=
                           evaluate_and_save(plan, *task, run, experiment, models, context.saved,
                                             noise_free, context.should_continue)
                               ? 1U
                               : 0U;
                     }
                     drop_signals(run);
                     runs.at(index) = std::move(run);
                     release_free_memory();  // the pieces of ever new sizes that runs leave
                   });
  return computed;
}

/// Makes one fit on one engine. Fitted runs that are `streamed` are simulated for it, and only
/// their reports remain in `runs`.
Fitted fit_streamed(const ExperimentContext& context, const std::set<std::size_t>& streamed,
                    const std::string& name, const std::string& simulator,
                    const TunedHyperparameters& chosen, const SavedTrials& saved,
                    MissingRun missing, Rollouts& runs) {
  const Plan& plan = context.plan;
  const auto found = plan.refits.find(name);
  const int refits = found == plan.refits.end() ? 0 : found->second;
  Experiment of_engine = context.request.experiment;
  of_engine.simulators = {simulator};
  Rollouts of_fit = simulate_fit(context, streamed, name, simulator, missing);
  Fitted one = fit_on(of_engine, of_fit.empty() ? runs : of_fit, name, refits,
                      context.should_continue, saved, chosen);
  for (auto& [index, run] : of_fit) {
    drop_signals(run);
    runs.emplace(index, std::move(run));
  }
  return one;
}

/// Writes and frees the phase models, which are large, of fits that neither tasks nor pictures need
/// any more.
void release_phase_models(const ExperimentContext& context, const PendingTasks& pending,
                          const TaskRange& tasks, FittedModels& models) {
  const Plan& plan = context.plan;
  if (!plan.model_tasks.empty()) return;
  const std::vector<std::string>& engines = context.request.experiment.simulators;
  const bool is_shard = tasks.size() < plan.tasks.size();
  for (auto& [key, by_estimator] : models) {
    const bool is_own = std::find(engines.begin(), engines.end(), key) != engines.end();
    const bool is_pictured = is_own && plan.kept_signals != KeptSignals::none;
    if (is_pictured || pending.needs(key)) continue;
    for (auto& [estimator, model] : by_estimator) {
      if (!model.phase) continue;
      if (!is_shard) write_model_of(key, estimator, model, context.directory);
      model.phase.reset();
      model.arrays.clear();
    }
  }
  release_free_memory();
}

/// Makes all fits. Where runs are streamed, tasks are evaluated as soon as their fits are there, so
/// that memory need not hold all models.
void fit_and_evaluate(ExperimentContext& context, const std::set<std::size_t>& streamed,
                      const TaskRange& tasks, MissingRun missing, Computed& done) {
  const Experiment& experiment = context.request.experiment;
  FittedModels& models = done.fitted.models;
  PendingTasks pending(context.plan, tasks);
  const auto evaluate_now = [&](const std::vector<std::size_t>& ready) {
    done.tasks += timed(context, "evaluate", [&] {
      return evaluate(context.plan, ready, done.runs, experiment, models, context.saved,
                      context.should_continue) +
             evaluate_streamed(context, streamed, ready, models, missing, done.runs);
    });
  };
  const SavedTrials saved(context.directory.path() / "state" / "tuning",
                          state_key(context.request));
  const NeededFits needed = needed_fits(context, streamed, done.runs);
  std::map<std::string, std::vector<Trial>> trials;  // by fit, then engine
  for (const std::string& simulator : needed.engines) {
    for (const std::string& name : needed.names) {
      timed(context, "fit", [&] {
        // Without `everywhere` other fits use the choice of the experiment's own.
        Fitted one = fit_streamed(context, streamed, name, simulator, chosen_in(trials[""]), saved,
                                  missing, done.runs);
        release_free_memory();
        models.merge(one.models);
        std::vector<Trial>& of_name = trials[name];
        std::move(one.trials.begin(), one.trials.end(), std::back_inserter(of_name));
        return 0;
      });
      if (streamed.empty()) continue;
      evaluate_now(pending.take_ready(models));
      release_phase_models(context, pending, tasks, models);
    }
  }
  for (auto& [name, of_name] : trials) {
    std::move(of_name.begin(), of_name.end(), std::back_inserter(done.fitted.trials));
  }
  if (!needed.engines.empty()) {
    timed(context, "fit", [&] {
      Experiment with_runs = experiment;
      with_runs.simulators = needed.engines;
      models.merge(fit_training_sets(with_runs, context, done.runs, chosen_in(done.fitted.trials)));
      return 0;
    });
    if (!context.should_continue()) throw Stopped();
  }
  evaluate_now(pending.take_all());
}

/// The runs that these tasks need, and the fitted runs of the experiment's own models if this share
/// has model tasks.
std::set<std::size_t> runs_for(const ExperimentContext& context, const TaskRange& tasks) {
  const Plan& plan = context.plan;
  std::set<std::size_t> runs = runs_for(plan, tasks);
  if (!has_model_tasks(plan, tasks)) return runs;
  for (std::size_t i = 0; i < plan.runs.size(); ++i) {
    if (plan.runs[i].role == RunRole::fit && plan.runs[i].fit.empty()) runs.insert(i);
  }
  return runs;
}

}  // namespace

Computed compute(ExperimentContext& context, const TaskRange& tasks, MissingRun missing) {
  try {
    Computed done;
    std::set<std::size_t> streamed;
    done.runs = timed(context, "simulate", [&] {
      std::set<std::size_t> needed = runs_for(context, tasks);
      for (auto index = needed.begin(); index != needed.end();) {
        const bool is_later = is_streamed(context.plan.runs[*index], context.plan);
        if (is_later) streamed.insert(*index);
        index = is_later ? needed.erase(index) : std::next(index);
      }
      return hold_rollouts(context, needed, missing);
    });
    fit_and_evaluate(context, streamed, tasks, missing, done);
    if (has_model_tasks(context.plan, tasks)) {
      timed(context, "model_tasks", [&] {
        run_model_tasks(context.plan, tasks, done.fitted.models, context.saved_model_tasks, missing,
                        context.should_continue);
        return 0;
      });
    }
    return done;
  } catch (const Stopped&) {
    throw Stopped(what_is_saved(context));
  }
}

}  // namespace touchdown::experiments
