#include <algorithm>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/program.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/fitting/fitting.hpp"
#include "experiments/plan/training_data.hpp"
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

/// Simulates the streamed runs of one fit.
Rollouts simulate_fit(const ExperimentContext& context, const NeededFit& fit,
                      const Computed& done) {
  std::set<std::size_t> wanted;
  for (const std::size_t index : done.streamed) {
    const PlannedRun& run = context.plan.runs[index];
    const bool is_wanted =
        run.role == RunRole::fit && run.fit == fit.name && run.simulator == fit.engine;
    if (is_wanted) wanted.insert(index);
  }
  return wanted.empty() ? Rollouts() : hold_rollouts(context, wanted, done.missing);
}

}  // namespace

std::vector<NeededFit> needed_fits(const ExperimentContext& context, const Computed& done) {
  const Plan& plan = context.plan;
  const bool has_later_tests = std::ranges::any_of(
      done.streamed, [&](std::size_t run) { return plan.runs[run].role == RunRole::test; });
  if (!has_later_tests && !is_any_scored(done.runs)) return {};
  std::set<std::size_t> all = done.streamed;
  all.insert(done.held.begin(), done.held.end());
  std::set<std::string> engines;
  std::vector<std::string> names = {""};  // the experiment's own fit: others use its tuning
  for (const std::size_t index : all) {
    const PlannedRun& run = plan.runs[index];
    engines.insert(run.simulator);
    const bool is_new =
        run.role == RunRole::fit && std::find(names.begin(), names.end(), run.fit) == names.end();
    if (is_new) names.push_back(run.fit);
  }
  std::vector<NeededFit> needed;
  for (const std::string& engine : context.request.experiment.simulators) {
    if (!engines.contains(engine)) continue;  // a shard may have runs of one engine only
    for (const std::string& name : names) needed.push_back({engine, name});
  }
  return needed;
}

void tune_and_fit(ExperimentContext& context, const NeededFit& needed, Computed& done) {
  const StageTimer timer(context, "fit");
  const std::string& engine = needed.engine;
  const std::string& fit = needed.name;
  Experiment experiment = context.request.experiment;
  experiment.simulators = {engine};
  Rollouts streamed = simulate_fit(context, needed, done);
  const Rollouts& runs = streamed.empty() ? done.runs : streamed;
  const RunPointers whole = whole_fit_runs(runs, engine, fit);
  const RunPointers segments =
      training_segments_of(runs, engine, experiment.training_segments, fit);
  TunedHyperparameters chosen = chosen_in(done.trials);
  if (experiment.tuning && (fit.empty() || experiment.tuning->everywhere)) {
    const std::vector<Trial> trials =
        tune(experiment, fit, whole, segments, context.should_continue, context.directory.store());
    chosen = chosen_in(trials);
    done.trials.insert(done.trials.end(), trials.begin(), trials.end());
    std::ranges::stable_sort(done.trials, {}, &Trial::fit);
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

void fit_training_sets(ExperimentContext& context, const std::vector<NeededFit>& fits,
                       Computed& done) {
  const Plan& plan = context.plan;
  if (plan.training_sets.empty() || fits.empty()) return;
  const StageTimer timer(context, "fit");
  Experiment experiment = context.request.experiment;
  std::erase_if(experiment.simulators, [&](const std::string& engine) {
    return std::ranges::none_of(fits, [&](const NeededFit& fit) { return fit.engine == engine; });
  });
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

}  // namespace touchdown::experiments
