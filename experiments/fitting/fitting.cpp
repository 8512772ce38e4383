#include "experiments/fitting/fitting.hpp"

#include <algorithm>
#include <atomic>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "core/error.hpp"
#include "core/progress.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/signals/reserved_seeds.hpp"

namespace touchdown::experiments {

namespace {

/// One model to fit, and the estimators that share it.
struct Job {
  std::string simulator;
  EstimatorEntry entry;
  std::vector<std::string> estimators;
  FittedModel model;
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

FittedModel fit_model(const EstimatorEntry& entry, const FitRuns& runs) {
  for (const auto* group : {&runs.whole, &runs.segments}) {
    for (const RunSignals* run : *group) check_may_be_fitted(run->info);
  }
  return entry.fit(entry, runs);
}

ModelMetadata new_metadata(const std::string& estimator, const FitRuns& runs,
                           const HyperparameterValues& hyperparameters) {
  FittedTo fitted_to;
  fitted_to.legs = legs_of(runs);
  fitted_to.servo_load = runs.servo_load;
  for (const auto* group : {&runs.whole, &runs.segments}) {
    for (const RunSignals* run : *group) fitted_to.add(run->info);
  }
  ModelMetadata metadata = new_metadata(estimator, fitted_to);
  put_into(metadata, hyperparameters);
  return metadata;
}

FittedModels fit_models(const Experiment& experiment, const RunPointers& fit_runs,
                        const RunPointers& segments, const std::function<bool()>& should_continue,
                        const TunedHyperparameters& of_tuning) {
  const TunedHyperparameters chosen = or_given(of_tuning, experiment);
  std::vector<Job> jobs = jobs_of(experiment, chosen);
  const auto stop_if_asked = [&] {
    if (should_continue && !should_continue()) throw Stopped();
  };
  const auto runs_of = [&](const std::string& simulator) {
    return FitRuns{of_engine(fit_runs, simulator), of_engine(segments, simulator),
                   experiment.scoring, stop_if_asked, experiment.fit_servo_load};
  };
  // Reference upper bounds take longest: they begin, so that no thread waits for them at the end.
  std::vector<Job*> in_order;
  for (Job& job : jobs) in_order.push_back(&job);
  std::stable_partition(in_order.begin(), in_order.end(),
                        [](const Job* job) { return job->entry.is_upper_bound; });
  std::atomic<std::size_t> next = 0;
  Progress progress("fitting", "models", static_cast<std::int64_t>(jobs.size()));
  tbb::parallel_for(std::size_t{0}, jobs.size(), [&](std::size_t /*number*/) {
    stop_if_asked();
    Job& job = *in_order[next++];
    const std::string& simulator = job.simulator;
    try {
      job.model = fit_model(job.entry, runs_of(simulator));
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
    const FitRuns runs = runs_of(job.simulator);
    for (const std::string& name : job.estimators) {
      job.model.hyperparameters = hyperparameters_of(chosen, job.simulator, name);
      job.model.metadata = new_metadata(name, runs, job.model.hyperparameters);
      models[job.simulator].insert_or_assign(name, job.model);
    }
  }
  return models;
}

}  // namespace touchdown::experiments
