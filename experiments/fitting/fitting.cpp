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
  const EstimatorEntry* entry;
  std::vector<std::string> estimators;
  FittedModel model;
};

std::vector<Job> jobs_of(const Experiment& experiment) {
  std::vector<Job> jobs;
  for (const std::string& simulator : experiment.simulators) {
    for (const std::string& name : experiment.estimators) {
      const EstimatorEntry& entry = estimator_entry(name);
      if (!entry.fits()) continue;
      const auto same = std::find_if(jobs.begin(), jobs.end(), [&](const Job& job) {
        return job.simulator == simulator && share_model(*job.entry, entry);
      });
      if (same != jobs.end()) {
        same->estimators.push_back(name);
      } else {
        jobs.push_back({simulator, &entry, {name}, {}});
      }
    }
  }
  return jobs;
}

std::vector<const RunSignals*> of_engine(const std::vector<RunSignals>& runs,
                                         const std::string& simulator) {
  std::vector<const RunSignals*> own;
  for (const RunSignals& run : runs) {
    if (run.info.simulator == simulator) own.push_back(&run);
  }
  return own;
}

FittedModel fitted(const EstimatorEntry& entry, const FitRuns& runs) {
  for (const auto* group : {&runs.whole, &runs.pieces}) {
    for (const RunSignals* run : *group) check_may_be_fitted(run->info);
  }
  return entry.fit(entry, runs);
}

}  // namespace

FittedModels fit_models(const Experiment& experiment, const std::vector<RunSignals>& fit_runs,
                        const std::vector<RunSignals>& pieces,
                        const std::function<bool()>& going_on) {
  std::vector<Job> jobs = jobs_of(experiment);
  const auto or_stop = [&] {
    if (going_on && !going_on()) throw Stopped();
  };
  Progress progress("fitting", "models", static_cast<std::int64_t>(jobs.size()));
  tbb::parallel_for(std::size_t{0}, jobs.size(), [&](std::size_t i) {
    or_stop();
    const std::string& simulator = jobs[i].simulator;
    try {
      jobs[i].model =
          fitted(*jobs[i].entry, {of_engine(fit_runs, simulator), of_engine(pieces, simulator),
                                  experiment.scoring, or_stop});
    } catch (const InputError& error) {
      throw InputError(fmt::format("fit on {}: {}", simulator, error.what()));
    }
    progress.advance();
  });
  const auto fitted_to_of = [&](const std::string& simulator) {
    FittedTo fitted_to;
    for (const auto* runs : {&fit_runs, &pieces}) {
      for (const RunSignals* run : of_engine(*runs, simulator)) fitted_to.add(run->info);
    }
    return fitted_to;
  };
  FittedModels models;
  for (Job& job : jobs) {
    const FittedTo fitted_to = fitted_to_of(job.simulator);
    for (const std::string& name : job.estimators) {
      job.model.passport = new_passport(name, fitted_to);
      models[job.simulator].emplace(name, job.model);
    }
  }
  return models;
}

}  // namespace touchdown::experiments
