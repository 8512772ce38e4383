#include "experiments/cost_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>
#include <utility>

#include "experiments/plan/condition.hpp"
#include "experiments/stages/experiment_context.hpp"
#include "experiments/stages/needs.hpp"

namespace touchdown::experiments {

namespace {

double duration_of(const PlannedRun& run, const Calibration& calibration) {
  const auto found = calibration.duration.find(scene_key(run));
  return found == calibration.duration.end() ? calibration.share * run.scenario.end.duration
                                             : found->second;
}

double steps_of(const PlannedRun& run, const Calibration& calibration) {
  return duration_of(run, calibration) * steps_per_second(run);
}

/// Runs that differ only in their sensors share a simulation. Those of every fit are simulated for
/// themselves.
double simulation_cost(const Plan& plan, const Calibration& calibration) {
  std::set<std::tuple<std::string, std::string, std::int64_t, std::uint64_t, int, std::string>>
      simulations;
  double seconds = 0.0;
  for (const PlannedRun& run : plan.runs) {
    const bool is_new = simulations
                            .emplace(run.scenario.name + run.scenario.robot.string(), run.simulator,
                                     run.run, run.seed, static_cast<int>(run.role), run.fit)
                            .second;
    const auto rate = calibration.step_seconds.find(run.simulator);
    if (is_new && rate != calibration.step_seconds.end())
      seconds += rate->second * steps_of(run, calibration);
  }
  return seconds;
}

/// Training data of one fit on one engine (s): whole runs and segments.
double training_seconds(const Experiment& experiment, const Plan& plan, const std::string& fit,
                        const Calibration& calibration) {
  double seconds = 0.0;
  for (const PlannedRun& run : plan.runs) {
    if (run.role != RunRole::fit || run.fit != fit) continue;
    if (run.simulator != experiment.simulators.front()) continue;
    double used = duration_of(run, calibration);
    if (run.group > 0) {
      used = std::min(used, experiment.training_segments[run.group - segment_group(0)].length);
    }
    seconds += used;
  }
  return seconds;
}

/// The evaluation of all tasks.
double evaluation_cost(const Plan& plan, const Calibration& calibration) {
  const EvaluationCost& cost = calibration.evaluation;
  const auto in_domain = [](const RunGroup& group, const std::string& engine) {
    const std::vector<Condition> tested = tested_on(group.conditions, engine);
    return static_cast<double>(std::count_if(
        tested.begin(), tested.end(),
        [&](const Condition& condition) { return condition.is_fitted_in_domain(group.fit); }));
  };
  double seconds = 0.0;
  for (const Task& task : plan.tasks) {
    const PlannedRun& run = plan.runs[task.run];
    const RunGroup& group = plan.groups[run.group];
    const RunGroup& own = plan.groups.front();
    const std::vector<Condition> tested = tested_on(group.conditions, run.simulator);
    const auto predicted = static_cast<double>(
        std::count_if(tested.begin(), tested.end(),
                      [&](const Condition& condition) { return group.predicts(condition); }));
    const double cells = own.scored.empty() ? 0.0
                                            : static_cast<double>(group.scored.size()) /
                                                  static_cast<double>(own.scored.size());
    const double counted_cells = own.counted.empty() ? 0.0
                                                     : static_cast<double>(group.counted.size()) /
                                                           static_cast<double>(own.counted.size());
    const double of_own = std::max(1.0, in_domain(own, run.simulator));
    const double steps = steps_of(run, calibration);
    seconds += (cost.scored.fixed + steps * cost.scored.per_step * cells) * predicted / of_own +
               (cost.counted.fixed + steps * cost.counted.per_step) * counted_cells;
  }
  return seconds;
}

/// The trials of one fit: every fold fits and evaluates all trials.
double tuning_cost(const RunRequest& request, const Plan& plan, const std::string& fit,
                   const Calibration& calibration) {
  const Experiment& experiment = request.experiment;
  const EvaluationCost& cost = calibration.evaluation;
  if (!experiment.tuning || !(fit.empty() || experiment.tuning->everywhere)) return 0.0;
  const TuningConfig& tuning = *experiment.tuning;
  const double fitted =
      training_seconds(experiment, plan, fit, calibration) * (tuning.folds - 1.0) / tuning.folds;
  double fits_of_trials = 0.0;
  for (const FitCost& one : calibration.fits.costs) {
    if (!is_tried(one.estimator, experiment)) continue;
    fits_of_trials += tuning.folds * (one.is_tuned ? tuning.trials : 1.0) * one.of(fitted);
  }
  double held_out = 0.0;  // steps
  double runs = 0.0;
  for (const PlannedRun& run : plan.runs) {
    if (run.role == RunRole::fit && run.fit == fit && run.group == 0 &&
        run.simulator == experiment.simulators.front()) {
      held_out += steps_of(run, calibration);
      runs += 1.0;
    }
  }
  const auto cells =
      static_cast<double>(std::max<std::size_t>(1, plan.groups.front().scored.size()));
  const double steps = held_out * static_cast<double>(tuning.noise.size()) / cells;
  const double evaluated = tuning.trials * (runs * cost.tried.fixed + steps * cost.tried.per_step);
  return static_cast<double>(experiment.simulators.size()) * (fits_of_trials + evaluated);
}

/// Memory of one simulated run on its way to signals, or of one run while it is evaluated.
double bytes_of_run(double steps, const Plan& plan) {
  constexpr double recorded_step_bytes =
      sizeof(models::Observation) + sizeof(models::Action) + sizeof(models::GroundTruth);
  constexpr double draws = 26.0 * sizeof(double);  // `NoiseRun`
  return steps * (recorded_step_bytes + signal_bytes_per_step(plan.needs_motion) + draws);
}

/// What is in memory at once: held signals, and of one fit on one engine the more of its signals
/// and work, or of a run per thread.
double memory_of(const Experiment& experiment, const Plan& plan, const Calibration& calibration) {
  double held = 0.0;
  double longest = 0.0;  // steps
  std::map<std::pair<std::string, std::string>, double> of_fit;
  for (const PlannedRun& run : plan.runs) {
    double steps = steps_of(run, calibration);
    longest = std::max(longest, steps);
    if (run.role == RunRole::fit && run.group > 0) {
      const TrainingSegments& segments = experiment.training_segments[run.group - segment_group(0)];
      steps = std::min(steps, segments.length * steps_per_second(run));
    }
    const double bytes = steps * signal_bytes_per_step(plan.needs_motion);
    if (!is_streamed(run, plan)) {
      held += bytes;
    } else if (run.role == RunRole::fit) {
      of_fit[{run.fit, run.simulator}] += bytes;
    }
  }
  double largest = 0.0;
  for (const auto& [fit, bytes] : of_fit) largest = std::max(largest, bytes);
  const int threads = threads_of(experiment);
  const double runs = threads * bytes_of_run(longest, plan);
  return calibration.memory_in_use + held +
         std::max(runs, largest + std::max(runs, calibration.fits.memory(threads)));
}

}  // namespace

double CostEstimate::seconds() const {
  double sum = 0.0;
  for (const StageCost& stage : stages) sum += std::isnan(stage.seconds) ? 0.0 : stage.seconds;
  return sum;
}

CostEstimate estimate_cost(const RunRequest& request, const Plan& plan,
                           const Calibration& calibration) {
  const Experiment& experiment = request.experiment;
  const FitSample& fits = calibration.fits;
  std::set<std::string> names = {""};
  for (const PlannedRun& run : plan.runs) {
    if (run.role == RunRole::fit) names.insert(run.fit);
  }
  const auto engines = static_cast<double>(experiment.simulators.size());
  double tune = 0.0;
  double fit = 0.0;
  for (const std::string& name : names) {
    const auto refits = plan.refits.find(name);
    const double repeated = refits == plan.refits.end() ? 0.0 : refits->second;
    const double seconds = training_seconds(experiment, plan, name, calibration);
    fit += engines * (fits.of(seconds) + repeated * fits.of_refit(seconds));
    tune += tuning_cost(request, plan, name, calibration);
  }
  CostEstimate estimate;
  estimate.stages.push_back({"simulate", simulation_cost(plan, calibration)});
  if (experiment.tuning) estimate.stages.push_back({"tune", tune});
  estimate.stages.push_back({"fit", fit});
  estimate.stages.push_back({"evaluate", evaluation_cost(plan, calibration)});
  if (!plan.model_tasks.empty()) {
    estimate.stages.push_back({"model_tasks", std::numeric_limits<double>::quiet_NaN()});
  }
  estimate.step_seconds = calibration.step_seconds;
  estimate.memory = memory_of(experiment, plan, calibration);
  estimate.disk = disk_needs(plan).all();
  estimate.measured = calibration.measured;
  estimate.unmeasured_fits = fits.unmeasured;
  return estimate;
}

}  // namespace touchdown::experiments
