#include "experiments/fitting.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "core/error.hpp"
#include "experiments/estimator_registry.hpp"
#include "experiments/phase_fitting.hpp"
#include "experiments/reserved_seeds.hpp"
#include "experiments/stopped.hpp"

namespace touchdown {

namespace {

/// One model to fit, and the estimators that share it.
struct Job {
  std::string simulator;
  std::optional<MeasurementConfig> measurement;
  std::optional<PhaseFitConfig> phase;
  std::vector<std::string> estimators;
  FittedModel model;

  bool fits_the_same(const Job& other) const {
    return simulator == other.simulator && measurement == other.measurement && phase == other.phase;
  }
};

std::vector<Job> jobs_of(const Experiment& experiment) {
  std::vector<Job> jobs;
  for (const std::string& simulator : experiment.simulators) {
    for (const std::string& name : experiment.estimators) {
      const EstimatorEntry& entry = estimator_entry(name);
      Job job{simulator, {}, {}, {name}, {}};
      if (entry.config) job.measurement = entry.config->measurement;
      if (entry.phase) job.phase = entry.phase->fit;
      if (!job.measurement && !job.phase) continue;
      const auto same = std::find_if(jobs.begin(), jobs.end(),
                                     [&](const Job& other) { return other.fits_the_same(job); });
      if (same != jobs.end()) {
        same->estimators.push_back(name);
      } else {
        jobs.push_back(std::move(job));
      }
    }
  }
  return jobs;
}

}  // namespace

LabelledTorques labelled_torques(std::span<const HeardRun* const> runs, const TorqueConfig& config,
                                 const ScoringConfig& scoring) {
  LabelledTorques torques;
  for (const HeardRun* run : runs) {
    const double period = 1e-6 * static_cast<double>(run->info.control_period_us);
    const auto skip = static_cast<std::size_t>(std::llround(scoring.skip / period));
    for (std::size_t leg = 0; leg < wheel_count; ++leg) {
      TorqueChannel channel(config, static_cast<Side>(leg), 1.0 / period);
      for (std::size_t k = 0; k < run->steps(); ++k) {
        const TorqueSample sample = channel.update(run->signals[k].leg[leg]);
        if (k < skip) continue;
        (run->contact[leg][k] != 0 ? torques.contact : torques.no_contact).push_back(sample);
      }
    }
  }
  return torques;
}

MeasurementModel fit(std::span<const HeardRun* const> runs, const MeasurementConfig& config,
                     const ScoringConfig& scoring) {
  for (const HeardRun* run : runs) check_may_be_fitted(run->info);
  const LabelledTorques torques = labelled_torques(runs, config.torque, scoring);
  return fit_measurement_model(torques.contact, torques.no_contact, config.fit);
}

FittedModels fit_models(const Experiment& experiment, const std::vector<HeardRun>& fit_runs,
                        const std::function<bool()>& going_on) {
  std::vector<Job> jobs = jobs_of(experiment);
  const auto or_stop = [&] {
    if (going_on && !going_on()) throw Stopped();
  };
  tbb::parallel_for(std::size_t{0}, jobs.size(), [&](std::size_t i) {
    or_stop();
    std::vector<const HeardRun*> runs;
    for (const HeardRun& run : fit_runs) {
      if (run.info.simulator == jobs[i].simulator) runs.push_back(&run);
    }
    try {
      if (jobs[i].measurement) {
        jobs[i].model.measurement = fit(runs, *jobs[i].measurement, experiment.scoring);
      } else {
        jobs[i].model.phase = std::make_shared<PhaseModelFile>(
            PhaseModelFile{fit_phases(runs, *jobs[i].phase, experiment.scoring.skip, or_stop),
                           provenance_of(runs, experiment.scoring.skip)});
      }
    } catch (const InputError& error) {
      throw InputError(fmt::format("fit on {}: {}", jobs[i].simulator, error.what()));
    }
  });
  FittedModels models;
  for (const Job& job : jobs) {
    for (const std::string& name : job.estimators) {
      models[job.simulator].emplace(name, job.model);
    }
  }
  return models;
}

}  // namespace touchdown
