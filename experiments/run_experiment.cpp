#include "experiments/run_experiment.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <span>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/fingerprint.hpp"
#include "experiments/config/experiment_estimators.hpp"
#include "experiments/fit_run_check.hpp"
#include "experiments/fitting/refits.hpp"
#include "experiments/needs.hpp"
#include "experiments/pending_tasks.hpp"
#include "experiments/process_memory.hpp"
#include "experiments/results/manifest.hpp"
#include "experiments/results/result_files.hpp"
#include "experiments/rollouts/failures.hpp"
#include "experiments/rollouts/training_segments.hpp"
#include "experiments/rollouts/training_sets.hpp"
#include "experiments/run_directory/own_files.hpp"
#include "experiments/run_directory/owner.hpp"
#include "experiments/run_directory/test_seed_log.hpp"
#include "experiments/signals/reserved_seeds.hpp"
#include "experiments/studies/experiment_file.hpp"
#include "experiments/studies/registry.hpp"
#include "experiments/tables/results.hpp"
#include "experiments/tuning/table.hpp"

namespace touchdown::experiments {

namespace {

/// Keeps of a run what tables need, and frees its signals.
void drop_signals(Rollout& run) {
  RunSignals left;
  left.info = std::move(run.signals.info);
  run.signals = std::move(left);
}

bool is_any_scored(const Rollouts& runs) {
  return std::any_of(runs.begin(), runs.end(), [](const auto& entry) {
    return entry.second.plan.role == RunRole::test && !entry.second.failed();
  });
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

bool is_engine_of(const Experiment& experiment, const std::string& simulator) {
  const std::vector<std::string>& engines = experiment.simulators;
  return std::find(engines.begin(), engines.end(), simulator) != engines.end();
}

/// The fitted models, and the tuning trials before the fit.
struct Fitted {
  FittedModels models;
  std::vector<Trial> trials;
};

/// Runs one of the experiment's fits on its engines, with its refits. It uses the hyperparameters
/// in `chosen` unless the fit has a tuning of its own.
Fitted fit(const Experiment& experiment, const Rollouts& runs, const std::string& name, int refits,
           const ShouldContinue& should_continue, const SavedTrials& saved,
           TunedHyperparameters chosen) {
  RunPointers fitted;
  for (const auto& [index, run] : runs) {
    const PlannedRun& plan = run.plan;
    const bool is_wanted = plan.role == RunRole::fit && plan.fit == name && plan.group == 0 &&
                           is_engine_of(experiment, plan.simulator);
    if (is_wanted && !run.failed()) fitted.push_back(&run.signals);
  }
  RunPointers segments;
  for (const std::string& simulator : experiment.simulators) {
    const RunPointers own =
        training_segments_of(runs, simulator, experiment.training_segments, name);
    segments.insert(segments.end(), own.begin(), own.end());
  }
  Fitted all;
  if (experiment.tuning && (name.empty() || experiment.tuning->everywhere)) {
    all.trials = tune(experiment, name, fitted, segments, should_continue, saved);
    chosen = chosen_in(all.trials);
  }
  const auto add = [&](int refit, FittedModels&& of_refit) {
    for (auto& [simulator, by_estimator] : of_refit) {
      if (!is_engine_of(experiment, simulator)) continue;
      all.models[model_key(simulator, name, refit)] = std::move(by_estimator);
    }
  };
  // Fits call this between their computations, and leave hundreds of megabytes in freed pieces.
  const ShouldContinue and_release = [&] {
    release_free_memory();
    return !should_continue || should_continue();
  };
  add(0, fit_models(experiment, fitted, segments, and_release, chosen));
  Experiment refitted = experiment;
  std::erase_if(refitted.estimators, [&](const std::string& estimator) {
    return estimator_entry(experiment, estimator).is_upper_bound;
  });
  for (int refit = 1; refit <= refits; ++refit) {
    add(refit, fit_models(refitted, drawn_anew(fitted, experiment.seed, refit),
                          drawn_anew(segments, experiment.seed, refit), and_release, chosen));
  }
  return all;
}

bool is_tested(const std::string& fit, const Rollouts& runs, const Plan& plan) {
  return std::any_of(runs.begin(), runs.end(), [&](const auto& entry) {
    const PlannedRun& run = entry.second.plan;
    if (run.role != RunRole::test) return false;
    const std::vector<Condition>& conditions = plan.groups[run.group].conditions;
    return std::any_of(conditions.begin(), conditions.end(),
                       [&](const Condition& condition) { return condition.fit == fit; });
  });
}

/// The fits to the plan's training sets, each with its refits, for every engine. Errors:
/// `InputError`, with the size of the set, when one does not suffice for a fit.
FittedModels fit_training_sets(const Experiment& experiment, const ExperimentContext& context,
                               const Rollouts& runs, const TunedHyperparameters& chosen) {
  FittedModels models;
  const Plan& plan = context.plan;
  if (plan.training_sets.empty()) return models;
  const TrainingPieces pieces = training_pieces(runs, experiment);
  Experiment of_pieces = experiment;
  of_pieces.scoring.skip = pieces.skip;
  for (const auto& [name, size] : plan.training_sets) {
    if (!is_tested(name, runs, plan)) continue;
    for (int refit = 0; refit <= plan.refits.at(name); ++refit) {
      const RunPointers set = training_set(
          refit == 0 ? pieces.runs : drawn_anew(pieces.runs, experiment.seed, refit), size);
      try {
        FittedModels of_set = fit_models(of_pieces, set, {}, context.should_continue, chosen);
        for (auto& [simulator, by_estimator] : of_set) {
          models[model_key(simulator, name, refit)] = std::move(by_estimator);
        }
      } catch (const InputError& error) {
        throw InputError(fmt::format("training sets of {}, number {}: {}: expected larger sets",
                                     size, refit + 1, error.what()));
      }
    }
  }
  return models;
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
                     for (const Task* task : tasks_of.at(index)) {
                       computed += evaluate_and_save(plan, *task, run, experiment, models,
                                                     context.saved, context.should_continue)
                                       ? 1U
                                       : 0U;
                     }
                     drop_signals(run);
                     runs.at(index) = std::move(run);
                     release_free_memory();  // the pieces of ever new sizes that runs leave
                   });
  return computed;
}

/// The engines and the names of the fits that the evaluation of these runs needs, both in the order
/// of the plan; none if no run can be scored.
struct NeededFits {
  std::vector<std::string> engines;
  std::vector<std::string> names;
};

NeededFits needed_fits(const ExperimentContext& context, const std::set<std::size_t>& streamed,
                       const Rollouts& runs) {
  const Plan& plan = context.plan;
  const bool has_later_tests = std::any_of(streamed.begin(), streamed.end(), [&](std::size_t run) {
    return plan.runs[run].role == RunRole::test;
  });
  NeededFits needed;
  if (!has_later_tests && !is_any_scored(runs)) return needed;
  std::set<std::string> engines;
  std::set<std::size_t> all = streamed;
  for (const auto& [index, run] : runs) all.insert(index);
  needed.names = {""};  // the experiment's own fit: others use its tuning
  for (const std::size_t index : all) {
    const PlannedRun& run = plan.runs[index];
    engines.insert(run.simulator);
    const bool is_new =
        run.role == RunRole::fit &&
        std::find(needed.names.begin(), needed.names.end(), run.fit) == needed.names.end();
    if (is_new) needed.names.push_back(run.fit);
  }
  for (const std::string& engine : context.request.experiment.simulators) {
    // A shard may have runs of one engine only.
    if (engines.contains(engine)) needed.engines.push_back(engine);
  }
  return needed;
}

/// Makes one fit on one engine. Fitted runs that are `streamed` are simulated for it, and only
/// their reports remain in `runs`.
Fitted fit(const ExperimentContext& context, const std::set<std::size_t>& streamed,
           const std::string& name, const std::string& simulator,
           const TunedHyperparameters& chosen, const SavedTrials& saved, MissingRun missing,
           Rollouts& runs) {
  const Plan& plan = context.plan;
  const auto found = plan.refits.find(name);
  const int refits = found == plan.refits.end() ? 0 : found->second;
  Experiment of_engine = context.request.experiment;
  of_engine.simulators = {simulator};
  Rollouts of_fit = simulate_fit(context, streamed, name, simulator, missing);
  Fitted one = fit(of_engine, of_fit.empty() ? runs : of_fit, name, refits, context.should_continue,
                   saved, chosen);
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
  for (auto& [key, by_estimator] : models) {
    const std::vector<std::string>& engines = context.request.experiment.simulators;
    const bool is_own = std::find(engines.begin(), engines.end(), key) != engines.end();
    const bool is_pictured = is_own && plan.kept_signals != KeptSignals::none;
    if (is_pictured || pending.needs(key)) continue;
    for (auto& [estimator, model] : by_estimator) {
      if (!model.phase) continue;
      const bool is_shard = tasks.size() < plan.tasks.size();
      if (!is_shard) write_model_of(key, estimator, model, context.directory);
      model.phase.reset();
    }
  }
  release_free_memory();
}

struct Computed {
  Rollouts runs;
  Fitted fitted;
  std::size_t tasks = 0;  ///< tasks that were not saved already
};

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
        Fitted one = fit(context, streamed, name, simulator, chosen_in(trials[""]), saved, missing,
                         done.runs);
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

/// The first half of an experiment: simulate → fit → evaluate → model tasks. Saved results are
/// read, not computed again.
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

/// Scores with intervals, and the studies. Errors: `Stopped`.
ExperimentResult score(ExperimentContext& context, Computed& done) {
  const Experiment& experiment = context.request.experiment;
  const Plan& plan = context.plan;
  ExperimentResult result{
      experiment, context.request.id, context.directory, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}};
  result.models = std::move(done.fitted.models);
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
    require_scored_run(done.runs);
    const CollectedCounts counts = collect(plan, plan.runs_in(0), context.saved);
    const scoring::BootstrapConfig& bootstrap = experiment.intervals.bootstrap;
    result.summaries = summarise(own(counts.counted), result.cells, bootstrap);
    const std::vector<ConditionScores> scored = own(counts.scored);
    result.scores = summarise(scored, experiment.highlights, bootstrap);
    result.differences = differences(scored, experiment.highlights, bootstrap);
    if (experiment.tuning) {
      add(summarize_tuning(done.fitted.trials, experiment, context.directory));
    }
    const Evaluation evaluation{
        context.request,          plan, done.runs, context.saved, counts, result.models,
        context.saved_model_tasks};
    for (const Study* study : requested_studies(experiment)) {
      add(study->summarize(evaluation, context.directory));
    }
    return 0;
  });
  return result;
}

/// The second half of an experiment: score → tables. It evaluates no estimator.
ExperimentResult summarize(ExperimentContext& context, Computed done) {
  const Experiment& experiment = context.request.experiment;
  ExperimentResult result = [&] {
    try {
      return score(context, done);
    } catch (const Stopped&) {
      throw Stopped(what_is_saved(context));
    }
  }();
  if (is_reserved(experiment.seed)) {
    const std::filesystem::path log = test_seed_log();
    const int others = log_evaluation(log, {experiment.seed, result.id, build_commit()});
    result.studies.push_back(fmt::format(
        "Seed {} is reserved for numbers that are reported once: other configurations or builds "
        "scored its runs {} times before ({})\n",
        experiment.seed, others, log.string()));
  }
  for (auto& [index, run] : done.runs) {
    if (run.plan.group == 0) result.runs.push_back(std::move(run));
  }
  result.provenance = context.provenance;
  write_result_files(result);
  write_results(context.request, context.directory);
  remove_shard_marks(context.directory.path());
  remove_partial_files(context.directory.path());
  write_manifest(result);
  return result;
}

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

}  // namespace

RunOutline outline_of(const Experiment& experiment, const RunOptions& options) {
  const RunRequest request = request_of(experiment);
  const std::filesystem::path directory = run_path(experiment.name, request.id, options.out);
  require_place(request, directory, options.overwrite);
  const Plan plan = whole_plan(request);
  const int threads = threads_of(experiment);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  try {
    const Calibration calibration =
        calibrate(request, plan, [stop = options.stop] { return stop == nullptr || !*stop; });
    return {directory, plan.tasks.size(), threads, estimate_cost(request, plan, calibration)};
  } catch (const Stopped&) {
    throw Stopped("stopped; nothing was written");
  }
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
