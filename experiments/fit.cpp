#include <algorithm>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/program.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/fitting/fitting.hpp"
#include "experiments/plan/rollouts.hpp"
#include "experiments/stages.hpp"

namespace touchdown::experiments {

namespace {

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
  const RunPointers whole = fit_runs_of(runs, engine, fit);
  TunedHyperparameters chosen = chosen_in(done.trials);
  if (experiment.tuning && (fit.empty() || experiment.tuning->everywhere)) {
    const std::vector<Trial> trials =
        tune(experiment, fit, whole, context.should_continue, context.directory.store());
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
  add(0, fit_models(experiment, whole, and_release, chosen));
  const auto refits = context.plan.refits.find(fit);
  const int count = refits == context.plan.refits.end() ? 0 : refits->second;
  for (int refit = 1; refit <= count; ++refit) {
    add(refit,
        fit_models(experiment, drawn_anew(whole, experiment.seed, refit), and_release, chosen));
  }
  for (auto& [index, run] : streamed) {
    drop_signals(run);
    done.runs.emplace(index, std::move(run));
  }
  release_free_memory();
}

}  // namespace touchdown::experiments
