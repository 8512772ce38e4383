#include "experiments/fitting/fitting.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "core/error.hpp"
#include "core/progress.hpp"
#include "estimator/signal_guard.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/fitting/phase_fitting.hpp"
#include "experiments/signals/reserved_seeds.hpp"

namespace touchdown::experiments {

namespace {

/// One model to fit, and the estimators that share it.
struct Job {
  std::string simulator;
  const EstimatorEntry* entry;
  std::vector<std::string> estimators;
  FittedModel model;

  bool fits(const EstimatorEntry& other) const {
    if (entry->fits() != other.fits()) return false;
    return entry->config ? entry->config->measurement == other.config->measurement
                         : entry->phase->fit == other.phase->fit;
  }
};

std::vector<Job> jobs_of(const Experiment& experiment) {
  std::vector<Job> jobs;
  for (const std::string& simulator : experiment.simulators) {
    for (const std::string& name : experiment.estimators) {
      const EstimatorEntry& entry = estimator_entry(name);
      if (!entry.fits()) continue;
      const auto same = std::find_if(jobs.begin(), jobs.end(), [&](const Job& job) {
        return job.simulator == simulator && job.fits(entry);
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

using RunPointers = std::vector<const RunSignals*>;

RunPointers of_engine(const std::vector<RunSignals>& runs, const std::string& simulator) {
  RunPointers own;
  for (const RunSignals& run : runs) {
    if (run.info.simulator == simulator) own.push_back(&run);
  }
  return own;
}

FittedModel fitted(const EstimatorEntry& entry, const RunPointers& runs, const RunPointers& pieces,
                   const scoring::ScoringConfig& scoring,
                   const std::function<void()>& before_density) {
  if (entry.config) return {fit(runs, entry.config->measurement, scoring), nullptr};
  const PhaseFitConfig& config = entry.phase->fit;
  return {{},
          std::make_shared<recordings::PhaseModelFile>(
              pieces.empty() ? fit_phases(runs, config, scoring.skip, before_density)
                             : fit_phases(pieces, config, 0.0, before_density))};
}

}  // namespace

MeasurementModel fit(std::span<const RunSignals* const> runs, const MeasurementConfig& config,
                     const scoring::ScoringConfig& scoring) {
  std::vector<TorqueSample> contact;
  std::vector<TorqueSample> no_contact;
  for (const RunSignals* run : runs) {
    check_may_be_fitted(run->info);
    const double period = 1e-6 * static_cast<double>(run->info.control_period_us);
    const std::size_t skip = scoring::first_scored_step(run->info.control_period_us, scoring);
    for (std::size_t leg = 0; leg < models::wheel_count; ++leg) {
      // As the filter processes them, by the label of their wheel.
      TorqueChannel channel(config.torque, static_cast<Side>(leg), 1.0 / period);
      for (std::size_t k = 0; k < run->steps(); ++k) {
        if (!has_torques(run->signals[k].leg[leg])) continue;  // nor does the filter use these
        const TorqueSample sample = channel.update(run->signals[k].leg[leg]);
        if (k >= skip) (run->contact[leg][k] != 0 ? contact : no_contact).push_back(sample);
      }
    }
  }
  return fit_measurement_model(contact, no_contact, config.fit);
}

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
      jobs[i].model = fitted(*jobs[i].entry, of_engine(fit_runs, simulator),
                             of_engine(pieces, simulator), experiment.scoring, or_stop);
    } catch (const InputError& error) {
      throw InputError(fmt::format("fit on {}: {}", simulator, error.what()));
    }
    progress.advance();
  });
  FittedModels models;
  for (const Job& job : jobs) {
    for (const std::string& name : job.estimators) {
      models[job.simulator].emplace(name, job.model);
    }
  }
  return models;
}

}  // namespace touchdown::experiments
