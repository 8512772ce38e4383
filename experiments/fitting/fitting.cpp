#include "experiments/fitting/fitting.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "core/error.hpp"
#include "core/progress.hpp"
#include "core/random.hpp"

namespace touchdown::experiments {

namespace {

using EngineAndScene = std::pair<std::string, std::string>;

/// The runs of every scene. If every scene of an engine has one run, the engine has a pool of all,
/// with an empty name of a scene.
std::map<EngineAndScene, RunPointers> pools_of(const RunPointers& runs) {
  std::map<EngineAndScene, RunPointers> pools;
  std::map<std::string, bool> has_repeated_scene;
  for (const RunSignals* run : runs) {
    RunPointers& pool = pools[{run->info.simulator, run->info.scenario}];
    pool.push_back(run);
    pools[{run->info.simulator, ""}].push_back(run);
    has_repeated_scene[run->info.simulator] |= pool.size() > 1;
  }
  for (const auto& [simulator, is_repeated] : has_repeated_scene) {
    if (is_repeated) pools.erase({simulator, ""});
  }
  return pools;
}

/// The runs that this one is drawn from.
const RunPointers& pool_of(const RunSignals& run,
                           const std::map<EngineAndScene, RunPointers>& pools) {
  const auto scenes = pools.find({run.info.simulator, ""});
  return scenes != pools.end() ? scenes->second : pools.at({run.info.simulator, run.info.scenario});
}

/// One model to fit, and the estimators that share it.
struct Job {
  std::string simulator;
  EstimatorEntry entry;
  std::vector<std::string> estimators;
  Model model;
};

const HyperparameterValues& hyperparameters_of(const TunedHyperparameters& chosen,
                                               const std::string& simulator,
                                               const std::string& estimator) {
  static const HyperparameterValues defaults;
  const auto engine = chosen.find(simulator);
  if (engine == chosen.end()) return defaults;
  const auto found = engine->second.find(estimator);
  return found == engine->second.end() ? defaults : found->second;
}

std::vector<Job> jobs_of(const Experiment& experiment, const TunedHyperparameters& chosen) {
  std::vector<Job> jobs;
  for (const std::string& simulator : experiment.simulators) {
    for (const std::string& name : experiment.estimators) {
      EstimatorEntry entry = with_hyperparameters(estimator_entry(experiment, name),
                                                  hyperparameters_of(chosen, simulator, name));
      if (!entry.fits()) continue;
      const auto same = std::find_if(jobs.begin(), jobs.end(), [&](const Job& job) {
        return job.simulator == simulator && share_model(job.entry, entry);
      });
      if (same != jobs.end()) {
        same->estimators.push_back(name);
      } else {
        jobs.push_back({simulator, std::move(entry), {name}, {}});
      }
    }
  }
  return jobs;
}

}  // namespace

EstimatorEntry entry_of(const Experiment& experiment, const Condition& condition,
                        const FittedModels& models) {
  const EstimatorEntry& entry = estimator_entry(experiment, condition.estimator);
  if (entry.hyperparameters.empty()) return entry;
  const auto fit = models.find(model_key(condition.fit_simulator, condition.fit, condition.refit));
  if (fit == models.end()) return entry;
  const auto model = fit->second.find(condition.estimator);
  return model == fit->second.end() ? entry
                                    : with_hyperparameters(entry, model->second.hyperparameters);
}

EstimatorSetup setup_of(const Experiment& experiment, const Condition& condition,
                        const FittedModels& models, const RunSignals& run) {
  const Model* model =
      estimator_entry(experiment, condition.estimator).fits()
          ? &models.at(model_key(condition.fit_simulator, condition.fit, condition.refit))
                 .at(condition.estimator)
          : nullptr;
  return {run.sample_rate(), model, run.legs, &run.contact};
}

std::unique_ptr<ContactEstimator> make_estimator(const Experiment& experiment,
                                                 const Condition& condition,
                                                 const FittedModels& models,
                                                 const RunSignals& run) {
  const EstimatorEntry entry = entry_of(experiment, condition, models);
  return entry.make(setup_of(experiment, condition, models, run));
}

EstimatorRunner runner_of(const Experiment& experiment, const Condition& condition,
                          const FittedModels& models, const RunSignals& run) {
  return entry_of(experiment, condition, models)
      .runner(setup_of(experiment, condition, models, run));
}

RunPointers drawn_anew(const RunPointers& runs, std::uint64_t seed, int number) {
  constexpr std::uint64_t stream = 0x7265666974;  // "refit"
  const std::map<EngineAndScene, RunPointers> pools = pools_of(runs);
  RunPointers drawn;
  for (std::size_t place = 0; place < runs.size(); ++place) {
    const RunPointers& pool = pool_of(*runs[place], pools);
    const double u = uniform01(seed, stream + static_cast<std::uint64_t>(number), place);
    drawn.push_back(pool[static_cast<std::size_t>(u * static_cast<double>(pool.size()))]);
  }
  return drawn;
}

TunedHyperparameters or_given(TunedHyperparameters chosen, const Experiment& experiment) {
  for (const auto& [simulator, by_estimator] : experiment.engine_hyperparameters) {
    for (const auto& [name, hyperparameters] : by_estimator) {
      chosen[simulator].try_emplace(name, hyperparameters);
    }
  }
  for (const std::string& simulator : experiment.simulators) {
    for (const auto& [name, hyperparameters] : experiment.hyperparameters) {
      chosen[simulator].try_emplace(name, hyperparameters);
    }
  }
  return chosen;
}

RunPointers of_engine(const RunPointers& runs, const std::string& simulator) {
  RunPointers own = runs;
  std::erase_if(own, [&](const RunSignals* run) { return run->info.simulator != simulator; });
  return own;
}

FittedModels fit_models(const Experiment& experiment, const RunPointers& fit_runs,
                        const std::function<bool()>& should_continue,
                        const TunedHyperparameters& of_tuning) {
  const TunedHyperparameters chosen = or_given(of_tuning, experiment);
  std::vector<Job> jobs = jobs_of(experiment, chosen);
  const auto stop_if_asked = [&] {
    if (should_continue && !should_continue()) throw Stopped();
  };
  const double skip = experiment.scoring.skip;
  Progress progress("fitting", "models", static_cast<std::int64_t>(jobs.size()));
  tbb::parallel_for(std::size_t{0}, jobs.size(), [&](std::size_t i) {
    stop_if_asked();
    Job& job = jobs[i];
    const std::string& simulator = job.simulator;
    try {
      job.model = job.entry.fit(of_engine(fit_runs, simulator), skip);
    } catch (const InputError& error) {
      throw InputError(fmt::format("fit on {}: {}", simulator, error.what()));
    }
    progress.advance();
  });
  FittedModels models;
  for (const auto& [simulator, by_estimator] : chosen) {
    for (const auto& [name, hyperparameters] : by_estimator)
      models[simulator][name].hyperparameters = hyperparameters;
  }
  for (Job& job : jobs) {
    const FittedTo fitted = fitted_to(of_engine(fit_runs, job.simulator), skip);
    for (const std::string& name : job.estimators) {
      FittedModel& model = models[job.simulator][name];
      static_cast<Model&>(model) = job.model;
      describe_fit(name, fitted, model.hyperparameters, model);
    }
  }
  return models;
}

}  // namespace touchdown::experiments
