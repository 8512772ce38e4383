#include <algorithm>
#include <array>
#include <map>
#include <mutex>
#include <set>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "core/program.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/fitting/fitting.hpp"
#include "experiments/plan/rollouts.hpp"
#include "experiments/stages.hpp"

namespace touchdown::experiments {

namespace {

/// One fit on one engine; `name` is empty for the experiment's own fit.
struct NeededFit {
  std::string engine;
  std::string name;
};

struct SavedModel {
  ModelArrays arrays;  ///< none for an estimator that is not fitted
  bool has_grid = false;
  HyperparameterValues hyperparameters;

  static auto members(auto& model) {
    return std::tie(model.arrays, model.has_grid, model.hyperparameters);
  }
};

/// A fit with its refits, as the store holds it.
struct SavedFit {
  std::map<std::string, std::map<std::string, SavedModel>> models;  ///< as in `FittedModels`
  std::vector<Trial> trials;
  std::map<std::size_t, RunReport> reports;  ///< of its runs, by index in the plan

  static auto members(auto& fit) { return std::tie(fit.models, fit.trials, fit.reports); }
};
constexpr const char* fit_parts = "fits";

std::string part_name(const NeededFit& fit) { return fit.engine + fit.name; }

std::set<std::size_t> runs_of(const NeededFit& fit, const Plan& plan) {
  std::set<std::size_t> runs;
  for (std::size_t index = 0; index < plan.runs.size(); ++index) {
    const PlannedRun& run = plan.runs[index];
    if (run.role == RunRole::fit && run.fit == fit.name && run.simulator == fit.engine) {
      runs.insert(index);
    }
  }
  return runs;
}

/// In the order of the experiment's engines, then of the plan. Own fits come first, because others
/// use their tuning.
std::vector<NeededFit> needed_fits(const ExperimentContext& context, const Computed& done) {
  const Plan& plan = context.plan;
  std::set<std::size_t> needed = runs_for(plan, done.share);
  if (has_model_tasks(plan, done.share)) {
    for (const std::string& engine : context.request.experiment.simulators) {
      needed.merge(runs_of({engine, ""}, plan));
    }
  }
  std::set<std::string> engines;
  std::vector<std::string> names = {""};
  for (const std::size_t index : needed) {
    const PlannedRun& run = plan.runs[index];
    engines.insert(run.simulator);
    const bool is_new =
        run.role == RunRole::fit && std::find(names.begin(), names.end(), run.fit) == names.end();
    if (is_new) names.push_back(run.fit);
  }
  std::vector<NeededFit> fits;
  for (const std::string& engine : context.request.experiment.simulators) {
    if (!engines.contains(engine)) continue;  // a shard may have runs of one engine only
    for (const std::string& name : names) fits.push_back({engine, name});
  }
  return fits;
}

SavedModel saved(const FittedModel& model) {
  return {has_numbers(model) ? arrays_of(model) : ModelArrays(), model.grid.has_value(),
          model.hyperparameters};
}

FittedModel restored(SavedModel saved) {
  FittedModel model;
  if (saved.has_grid) {
    static_cast<Model&>(model) = model_of(std::move(saved.arrays));
  } else {
    model.metadata = metadata_of(saved.arrays);
    saved.arrays.erase(std::string(metadata_array));
    model.arrays = std::move(saved.arrays);
  }
  model.hyperparameters = std::move(saved.hyperparameters);
  return model;
}

std::map<std::size_t, Rollout> simulate(const ExperimentContext& context, const NeededFit& fit) {
  std::map<std::size_t, Rollout> runs;
  std::mutex mutex;
  for_each_rollout("simulating for the fit", context.request.experiment, context.plan,
                   runs_of(fit, context.plan), context.directory, MissingRun::simulate,
                   context.should_continue, [&](std::size_t index, Rollout run) {
                     const std::lock_guard lock(mutex);
                     runs.emplace(index, std::move(run));
                   });
  return runs;
}

/// Simulates the runs of a fit, tunes and fits. `chosen`: by the experiment's own tuning.
SavedFit make(const ExperimentContext& context, const NeededFit& fit, TunedHyperparameters chosen) {
  Experiment experiment = context.request.experiment;
  experiment.simulators = {fit.engine};
  SavedFit made;
  std::vector<Rollout> runs;
  for (auto& [index, run] : simulate(context, fit)) {
    made.reports.emplace(index, run.report);
    runs.push_back(std::move(run));
  }
  require_fittable(experiment, runs);
  RunPointers whole;
  for (const Rollout& run : runs) {
    if (!run.failed()) whole.push_back(&run.signals);
  }
  if (experiment.tuning && (fit.name.empty() || experiment.tuning->everywhere)) {
    made.trials =
        tune(experiment, fit.name, whole, context.should_continue, context.directory.store());
    chosen = chosen_in(made.trials);
  }
  const auto add = [&](int refit, const FittedModels& models) {
    const auto of_engine = models.find(fit.engine);
    if (of_engine == models.end()) return;
    for (const auto& [estimator, model] : of_engine->second) {
      made.models[model_key(fit.engine, fit.name, refit)].emplace(estimator, saved(model));
    }
  };
  // Fits call this between their computations, and leave hundreds of megabytes in freed pieces.
  const ShouldContinue and_release = [&] {
    release_free_memory();
    return context.should_continue();
  };
  add(0, fit_models(experiment, whole, and_release, chosen));
  const auto refits = context.plan.refits.find(fit.name);
  const int count = refits == context.plan.refits.end() ? 0 : refits->second;
  for (int refit = 1; refit <= count; ++refit) {
    add(refit,
        fit_models(experiment, drawn_anew(whole, experiment.seed, refit), and_release, chosen));
  }
  return made;
}

/// The saved fit, if its recordings are there, too.
std::optional<SavedFit> find(const ExperimentContext& context, const NeededFit& fit) {
  const bool has_recordings = std::ranges::all_of(runs_of(fit, context.plan), [&](std::size_t run) {
    return is_recorded(context.plan.runs[run], context.directory);
  });
  if (!has_recordings) return std::nullopt;
  return context.directory.store().find<SavedFit>(fit_parts, part_name(fit));
}

}  // namespace

void fit(ExperimentContext& context, Computed& done) {
  const StageTimer timer(context, "fit");
  for (const NeededFit& needed : needed_fits(context, done)) {
    std::optional<SavedFit> fit = find(context, needed);
    if (!fit) {
      fit = make(context, needed, chosen_in(done.trials));
      context.directory.store().put(fit_parts, part_name(needed), *fit);
      release_free_memory();
    }
    for (auto& [key, by_estimator] : fit->models) {
      for (auto& [estimator, model] : by_estimator) {
        done.models[key].emplace(estimator, restored(std::move(model)));
      }
    }
    for (auto& [index, report] : fit->reports) {
      done.runs.emplace(index, FinishedRun{context.plan.runs[index], std::move(report)});
    }
    done.trials.insert(done.trials.end(), fit->trials.begin(), fit->trials.end());
    std::ranges::stable_sort(done.trials, {}, &Trial::fit);
  }
}

void require_fittable(const Experiment& experiment, const std::vector<Rollout>& fitted_runs) {
  std::vector<std::string> fitted;
  for (const std::string& name : experiment.estimators) {
    if (estimator_entry(experiment, name).fits()) fitted.push_back(name);
  }
  if (fitted.empty() || fitted_runs.empty()) return;
  std::array<bool, 3> has_contact = {};  // of so many wheels, at any step
  std::set<std::string> scenes;
  std::map<std::string, std::string> failures;  // endings by file
  for (const Rollout& run : fitted_runs) {
    scenes.insert(run.plan.scenario.name);
    if (run.failed()) {
      failures[run.plan.file] = run.report.ending;
      continue;
    }
    const auto& [left, right] = run.signals.contact;
    for (std::size_t k = 0; k < left.size(); ++k) {
      has_contact.at(static_cast<std::size_t>(left[k] + right[k])) = true;
    }
  }
  const auto refuse = [&](const std::string& why) {
    throw InputError(fmt::format("fit on {}: {}: {}", fitted_runs.front().plan.simulator,
                                 fmt::join(fitted, ", "), why));
  };
  if (failures.size() == fitted_runs.size()) {
    refuse("no run of fit.scenarios stayed upright: " + failures_text(failures));
  }
  const auto [flight, one_wheel, rolling] = has_contact;
  const char* const missing = !rolling && !one_wheel  ? "contact"
                              : !flight && !one_wheel ? "step without contact"
                                                      : nullptr;
  if (missing != nullptr) {
    refuse(fmt::format("fit.scenarios contain no {}: {}", missing, fmt::join(scenes, ", ")));
  }
}

}  // namespace touchdown::experiments
