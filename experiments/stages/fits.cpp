#include "experiments/stages/fits.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "experiments/config/experiment_estimators.hpp"
#include "experiments/fitting/fitting.hpp"
#include "experiments/rollouts/training_segments.hpp"
#include "experiments/rollouts/training_sets.hpp"
#include "experiments/stages/process_memory.hpp"

namespace touchdown::experiments {

namespace {

bool is_engine_of(const Experiment& experiment, const std::string& simulator) {
  const std::vector<std::string>& engines = experiment.simulators;
  return std::find(engines.begin(), engines.end(), simulator) != engines.end();
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

}  // namespace

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

Fitted fit_on(const Experiment& experiment, const Rollouts& runs, const std::string& name,
              int refits, const ShouldContinue& should_continue, const SavedTrials& saved,
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

}  // namespace touchdown::experiments
