#include "experiments/needs.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "core/error.hpp"
#include "experiments/evaluation/tasks.hpp"
#include "experiments/studies/registry.hpp"

namespace touchdown::experiments {

namespace {

/// Memory of a planned run with its scenario's terrain and scripts.
constexpr double planned_bytes = sizeof(PlannedRun) + 512.0;
/// Memory per step of a rollout.
constexpr double signal_step_bytes =
    sizeof(Signals) + sizeof(Eigen::Vector3d) +
    static_cast<double>(models::wheel_count) * (sizeof(double) + 1.0);

/// Additional memory per step where test runs keep their motion.
constexpr double motion_step_bytes = sizeof(Eigen::Vector3d) + sizeof(scoring::TimedPose);

/// Adds the fitted runs of the experiment's own fit on so many engines.
void add_fitted_runs(const RunRequest& request, double engines, Needs& needs) {
  const Experiment& experiment = request.experiment;
  for (const std::string& file : experiment.fit.scenarios) {
    add_runs(needs, scenario_of(request, file).scenario, engines * experiment.fit.runs, 0.0);
  }
}

/// Steps of the runs that have signals in memory at once.
double held_steps(const RunRequest& request, const Needs& all) {
  const Experiment& experiment = request.experiment;
  const KeptSignals kept = kept_signals(experiment);
  if (kept == KeptSignals::all) return all.steps;
  Needs held;
  add_fitted_runs(request, 1.0, held);  // engine by engine
  for (const std::string& file : experiment.test.scenarios) {
    if (kept == KeptSignals::none) break;
    const auto engines = static_cast<double>(experiment.simulators.size());
    add_runs(held, scenario_of(request, file).scenario, engines * experiment.test.runs, 0.0);
  }
  return held.steps;
}

double planned_memory(const Needs& needs) {
  return needs.runs * planned_bytes + needs.parts * sizeof(Task);
}

/// Memory of the signals that are held at once.
double held_memory(const RunRequest& request, const Needs& needs) {
  return held_steps(request, needs) *
         (signal_step_bytes + (needs.motion ? motion_step_bytes : 0.0));
}

/// Size of the files of a plan's parts (bytes).
double bytes_of_parts(const Plan& plan) {
  constexpr double block = 4096.0;  // of a disk
  constexpr double head = 256.0;
  std::vector<double> of_group;
  for (const RunGroup& group : plan.groups) {
    double estimators = 0.0;
    for (const Condition& condition : group.conditions) {
      const auto tested =
          static_cast<double>(tested_on(group.conditions, condition.test_simulator).size());
      estimators = std::max(estimators, tested);
    }
    double bytes_of_run = head;
    double bytes_of_prediction = sizeof(scoring::RobotScore);
    for (const Measure& measure : group.measures) {
      bytes_of_run += static_cast<double>(measure.bytes_of_run);
      bytes_of_prediction += head + static_cast<double>(measure.bytes_of_prediction);
    }
    const double bytes =
        bytes_of_run +
        estimators * (static_cast<double>(group.counted.size()) * sizeof(scoring::Classification) +
                      static_cast<double>(group.scored.size()) * bytes_of_prediction);
    of_group.push_back(block * std::ceil(bytes / block));
  }
  double bytes = 0.0;
  for (const Task& task : plan.tasks) bytes += of_group[plan.runs[task.run].group];
  return bytes;
}

/// An upper bound of the size of `tables/samples.csv` (bytes).
double bytes_of_samples(const Plan& plan, const Experiment& experiment) {
  constexpr double numbers = 140.0;  // of a row, at most
  const RunGroup& group = plan.groups.front();
  const bool is_by_drop = experiment.intervals.over == scoring::SampleUnit::drop;
  double bytes = 0.0;
  for (const std::size_t index : plan.runs_in(0)) {
    const PlannedRun& run = plan.runs[index];
    const double samples =
        is_by_drop ? std::ceil(run.scenario.end.duration / experiment.scoring.minimum_flight) : 1.0;
    for (const Condition& condition : tested_on(group.conditions, run.simulator)) {
      if (!condition.fit.empty() || !group.counts(condition)) continue;
      const std::size_t names = condition.fit_simulator.size() + condition.test_simulator.size() +
                                condition.estimator.size() + run.scenario.name.size();
      bytes += samples * static_cast<double>(group.counted.size()) *
               (numbers + static_cast<double>(names));
    }
  }
  return bytes;
}

}  // namespace

Needs needs_of(const RunRequest& request) {
  const Experiment& experiment = request.experiment;
  const auto engines = static_cast<double>(experiment.simulators.size());
  const double seeds = experiment.noise.seeds;
  Needs needs;
  add_fitted_runs(request, engines, needs);
  for (const Study* study : requested_studies(experiment)) study->add_needs(request, needs);
  for (const std::string& file : experiment.test.scenarios) {
    add_runs(needs, scenario_of(request, file).scenario, engines * experiment.test.runs, seeds,
             needs.setups);
  }
  return needs;
}

KeptSignals kept_signals(const Experiment& experiment) {
  const std::vector<const Study*> studies = requested_studies(experiment);
  if (studies.empty()) return KeptSignals::all;
  const bool has_pictures = experiment.video.enabled || experiment.detail;
  KeptSignals kept = has_pictures ? KeptSignals::own : KeptSignals::none;
  for (const Study* study : studies) kept = std::max(kept, study->kept_signals(experiment));
  return kept;
}

double least_memory(const RunRequest& request, double share_of_runs) {
  const Needs needs = needs_of(request);
  return planned_memory(needs) + share_of_runs * held_memory(request, needs);
}

void require_memory(const RunRequest& request, double share_of_runs, double memory) {
  const Needs needs = needs_of(request);
  const double planned = planned_memory(needs);
  const double held = share_of_runs * held_memory(request, needs);
  if (planned + held <= memory) return;
  const Experiment& experiment = request.experiment;
  const bool too_long = held > planned;
  throw Error(fmt::format(
      "{}: {:.0f} runs of {:.0f} s together and {:.0f} parts (test.runs={}, fit.runs={}, "
      "noise.seeds={}) need at least {:.1f} GB of memory, and this process may use {:.1f} GB: {}",
      experiment.name, needs.runs, needs.seconds, needs.parts, experiment.test.runs,
      experiment.fit.runs, experiment.noise.seeds, 1e-9 * (planned + held), 1e-9 * memory,
      too_long ? "lower test.runs or fit.runs, or compute it in shards (--shard)"
               : "lower test.runs or noise.seeds"));
}

DiskNeeds disk_needs(const Plan& plan, const Experiment& experiment,
                     const RunDirectory* directory) {
  constexpr double recorded_step_bytes = 1100.0;  // 1.05 kB were measured
  DiskNeeds needs{.samples = bytes_of_samples(plan, experiment)};
  for (const PlannedRun& run : plan.runs) {
    if (!run.kept || (directory != nullptr && has_stamp(run, *directory))) continue;
    needs.recordings += recorded_step_bytes * run.scenario.end.duration /
                        (1e-6 * static_cast<double>(run.scenario.simulation.steps.control_us));
  }
  if (plan.tasks.empty()) return needs;
  const auto parts = static_cast<double>(plan.tasks.size());
  const double saved =
      directory == nullptr ? 0.0 : static_cast<double>(directory->store().names(task_parts).size());
  needs.parts = bytes_of_parts(plan) * std::max(0.0, parts - saved) / parts;
  return needs;
}

}  // namespace touchdown::experiments
