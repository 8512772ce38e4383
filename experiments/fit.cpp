#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/program.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/fitting/fitting.hpp"
#include "experiments/plan/training_data.hpp"
#include "experiments/results/result_files.hpp"
#include "experiments/stages.hpp"

namespace touchdown::experiments {

namespace {

bool is_tested(const std::string& fit, const Rollouts& runs, const Plan& plan) {
  return std::any_of(runs.begin(), runs.end(), [&](const auto& entry) {
    const PlannedRun& run = entry.second.plan;
    if (run.role != RunRole::test) return false;
    const std::vector<Condition>& conditions = plan.groups[run.group].conditions;
    return std::any_of(conditions.begin(), conditions.end(),
                       [&](const Condition& condition) { return condition.fit == fit; });
  });
}

/// Simulates the streamed runs of one fit on one engine.
Rollouts simulate_fit(const ExperimentContext& context, const NeededRuns& needed,
                      const std::string& engine, const std::string& fit, MissingRun missing) {
  std::set<std::size_t> wanted;
  for (const std::size_t index : needed.streamed) {
    const PlannedRun& run = context.plan.runs[index];
    if (run.role == RunRole::fit && run.fit == fit && run.simulator == engine) wanted.insert(index);
  }
  return wanted.empty() ? Rollouts() : hold_rollouts(context, wanted, missing);
}

}  // namespace

NeededFits needed_fits(const ExperimentContext& context, const NeededRuns& needed_runs,
                       const Rollouts& runs) {
  const Plan& plan = context.plan;
  const std::set<std::size_t>& streamed = needed_runs.streamed;
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

void tune_and_fit(const ExperimentContext& context, const NeededRuns& needed,
                  const std::string& engine, const std::string& fit, MissingRun missing,
                  Computed& done) {
  Experiment experiment = context.request.experiment;
  experiment.simulators = {engine};
  Rollouts streamed = simulate_fit(context, needed, engine, fit, missing);
  const Rollouts& runs = streamed.empty() ? done.runs : streamed;
  RunPointers whole;
  for (const auto& [index, run] : runs) {
    const PlannedRun& plan = run.plan;
    const bool is_wanted =
        plan.role == RunRole::fit && plan.fit == fit && plan.group == 0 && plan.simulator == engine;
    if (is_wanted && !run.failed()) whole.push_back(&run.signals);
  }
  const RunPointers segments =
      training_segments_of(runs, engine, experiment.training_segments, fit);
  TunedHyperparameters chosen = chosen_in(done.trials);
  if (experiment.tuning && (fit.empty() || experiment.tuning->everywhere)) {
    const std::vector<Trial> trials =
        tune(experiment, fit, whole, segments, context.should_continue, context.directory.store());
    chosen = chosen_in(trials);
    done.trials.insert(done.trials.end(), trials.begin(), trials.end());
    std::stable_sort(done.trials.begin(), done.trials.end(),
                     [](const Trial& a, const Trial& b) { return a.fit < b.fit; });
  }
  const auto add = [&](int refit, FittedModels&& models) {
    const auto of_engine = models.find(engine);
    if (of_engine == models.end()) return;
    done.models.try_emplace(model_key(engine, fit, refit), std::move(of_engine->second));
  };
  // Fits call this between their computations, and leave hundreds of megabytes in freed pieces.
  const ShouldContinue and_release = [&] {
    release_free_memory();
    return context.should_continue();
  };
  add(0, fit_models(experiment, whole, segments, and_release, chosen));
  Experiment refitted = experiment;
  std::erase_if(refitted.estimators, [&](const std::string& estimator) {
    return estimator_entry(experiment, estimator).is_upper_bound;
  });
  const auto refits = context.plan.refits.find(fit);
  const int count = refits == context.plan.refits.end() ? 0 : refits->second;
  for (int refit = 1; refit <= count; ++refit) {
    add(refit, fit_models(refitted, drawn_anew(whole, experiment.seed, refit),
                          drawn_anew(segments, experiment.seed, refit), and_release, chosen));
  }
  for (auto& [index, run] : streamed) {
    drop_signals(run);
    done.runs.emplace(index, std::move(run));
  }
  release_free_memory();
}

void fit_training_sets(const ExperimentContext& context, const NeededFits& fits, Computed& done) {
  const Plan& plan = context.plan;
  if (plan.training_sets.empty()) return;
  Experiment experiment = context.request.experiment;
  experiment.simulators = fits.engines;
  const TunedHyperparameters chosen = chosen_in(done.trials);
  const TrainingPieces pieces = training_pieces(done.runs, experiment);
  experiment.scoring.skip = pieces.skip;
  for (const auto& [name, size] : plan.training_sets) {
    if (!is_tested(name, done.runs, plan)) continue;
    for (int refit = 0; refit <= plan.refits.at(name); ++refit) {
      const RunPointers set = training_set(
          refit == 0 ? pieces.runs : drawn_anew(pieces.runs, experiment.seed, refit), size);
      try {
        FittedModels of_set = fit_models(experiment, set, {}, context.should_continue, chosen);
        for (auto& [simulator, by_estimator] : of_set) {
          done.models.try_emplace(model_key(simulator, name, refit), std::move(by_estimator));
        }
      } catch (const InputError& error) {
        throw InputError(fmt::format("training sets of {}, number {}: {}: expected larger sets",
                                     size, refit + 1, error.what()));
      }
    }
  }
}

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

}  // namespace touchdown::experiments
