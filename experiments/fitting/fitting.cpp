#include "experiments/fitting/fitting.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "core/error.hpp"
#include "core/progress.hpp"
#include "experiments/estimators/registry.hpp"
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

const Constants& constants_of(const ChosenConstants& chosen, const std::string& simulator,
                              const std::string& estimator) {
  static const Constants defaults;
  const auto engine = chosen.find(simulator);
  if (engine == chosen.end()) return defaults;
  const auto found = engine->second.find(estimator);
  return found == engine->second.end() ? defaults : found->second;
}

std::vector<Job> jobs_of(const Experiment& experiment, const ChosenConstants& chosen) {
  std::vector<Job> jobs;
  for (const std::string& simulator : experiment.simulators) {
    for (const std::string& name : experiment.estimators) {
      EstimatorEntry entry =
          with_constants(estimator_entry(name), constants_of(chosen, simulator, name));
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

ChosenConstants or_given(ChosenConstants chosen, const Experiment& experiment) {
  for (const std::string& simulator : experiment.simulators) {
    for (const auto& [name, constants] : experiment.constants) {
      chosen[simulator].try_emplace(name, constants);
    }
  }
  return chosen;
}

std::vector<const RunSignals*> of_engine(const std::vector<RunSignals>& runs,
                                         const std::string& simulator) {
  std::vector<const RunSignals*> own;
  for (const RunSignals& run : runs) {
    if (run.info.simulator == simulator) own.push_back(&run);
  }
  return own;
}

FittedModel fit_model(const EstimatorEntry& entry, const FitRuns& runs) {
  for (const auto* group : {&runs.whole, &runs.pieces}) {
    for (const RunSignals* run : *group) check_may_be_fitted(run->info);
  }
  return entry.fit(entry, runs);
}

ModelPassport new_passport(const std::string& estimator, const FitRuns& runs,
                           const Constants& constants) {
  FittedTo fitted_to;
  fitted_to.legs = legs_of(runs);
  for (const auto* group : {&runs.whole, &runs.pieces}) {
    for (const RunSignals* run : *group) fitted_to.add(run->info);
  }
  ModelPassport passport = new_passport(estimator, fitted_to);
  put_into(passport, constants);
  return passport;
}

FittedModels fit_models(const Experiment& experiment, const std::vector<RunSignals>& fit_runs,
                        const std::vector<RunSignals>& pieces,
                        const std::function<bool()>& going_on, const ChosenConstants& of_tuning) {
  const ChosenConstants chosen = or_given(of_tuning, experiment);
  std::vector<Job> jobs = jobs_of(experiment, chosen);
  const auto or_stop = [&] {
    if (going_on && !going_on()) throw Stopped();
  };
  const auto runs_of = [&](const std::string& simulator) {
    return FitRuns{of_engine(fit_runs, simulator), of_engine(pieces, simulator), experiment.scoring,
                   or_stop};
  };
  Progress progress("fitting", "models", static_cast<std::int64_t>(jobs.size()));
  tbb::parallel_for(std::size_t{0}, jobs.size(), [&](std::size_t i) {
    or_stop();
    const std::string& simulator = jobs[i].simulator;
    try {
      jobs[i].model = fit_model(jobs[i].entry, runs_of(simulator));
    } catch (const InputError& error) {
      throw InputError(fmt::format("fit on {}: {}", simulator, error.what()));
    }
    progress.advance();
  });
  FittedModels models;
  for (const auto& [simulator, by_estimator] : chosen) {
    for (const auto& [name, constants] : by_estimator)
      models[simulator][name].constants = constants;
  }
  for (Job& job : jobs) {
    const FitRuns runs = runs_of(job.simulator);
    for (const std::string& name : job.estimators) {
      job.model.constants = constants_of(chosen, job.simulator, name);
      job.model.passport = new_passport(name, runs, job.model.constants);
      models[job.simulator].insert_or_assign(name, job.model);
    }
  }
  return models;
}

}  // namespace touchdown::experiments
