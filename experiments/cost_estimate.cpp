#include "experiments/cost_estimate.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <mutex>
#include <set>
#include <tuple>
#include <utility>

#include "core/error.hpp"
#include "core/files.hpp"
#include "experiments/config/experiment_estimators.hpp"
#include "experiments/evaluation/tasks.hpp"
#include "experiments/experiment_context.hpp"
#include "experiments/fit_cost.hpp"
#include "experiments/needs.hpp"
#include "experiments/process_memory.hpp"
#include "experiments/processor_time.hpp"
#include "experiments/rollouts/rollouts.hpp"

namespace touchdown::experiments {

namespace {

/// Limits of the calibration.
constexpr std::size_t most_scenes = 16;    // simulated on the first engine
constexpr double evaluated_seconds = 2.0;  // of one run, and a quarter of them

/// Runs of one scene by one robot are about equally long in every engine.
using SceneKey = std::tuple<std::string, std::string>;

SceneKey scene_key(const PlannedRun& run) {
  return {run.scenario.name, run.scenario.robot.string()};
}

double steps_per_second(const PlannedRun& run) {
  return 1e6 / static_cast<double>(run.scenario.simulation.steps.control_us);
}

/// At most `most` of the indices, evenly spread.
std::set<std::size_t> spread(const std::vector<std::size_t>& all, std::size_t most) {
  std::set<std::size_t> chosen;
  const std::size_t count = std::min(most, all.size());
  for (std::size_t i = 0; i < count; ++i) chosen.insert(all[i * all.size() / count]);
  return chosen;
}

/// The simulated part of the calibration.
struct Sample {
  Rollouts runs;
  std::map<std::string, double> step_seconds;  ///< by engine
  std::map<SceneKey, double> duration;         ///< s
  double share = 1.0;                          ///< of the planned duration, where not simulated
};

void simulate(const Experiment& experiment, const Plan& plan, const std::set<std::size_t>& chosen,
              const std::string& engine, const ShouldContinue& should_continue, Sample& sample) {
  if (chosen.empty()) return;
  Plan unkept = plan;
  for (PlannedRun& run : unkept.runs) run.kept = false;
  const PartFolder scratch(temporary_folder() / "touchdown_calibration");  // notes of failed runs
  const RunDirectory directory("calibration", "calibration", scratch.path());
  std::mutex mutex;
  double steps = 0.0;
  const double cost = cost_of([&] {
    for_each_rollout(experiment, unkept, chosen, directory, MissingRun::simulate, should_continue,
                     [&](std::size_t index, Rollout run) {
                       const std::lock_guard lock(mutex);
                       steps += run.report.duration * steps_per_second(run.plan);
                       sample.runs.insert_or_assign(index, std::move(run));
                     });
  });
  if (steps > 0.0) sample.step_seconds[engine] = cost / steps;
}

/// Simulates one run of every scene on the first engine, and one on every other engine.
Sample sampled(const Experiment& experiment, const Plan& plan,
               const ShouldContinue& should_continue) {
  Sample sample;
  std::map<std::string, std::vector<std::size_t>> candidates;
  std::set<std::pair<SceneKey, RunRole>> known;
  for (std::size_t i = 0; i < plan.runs.size(); ++i) {
    const PlannedRun& run = plan.runs[i];
    const bool is_first_engine = run.simulator == experiment.simulators.front();
    if (is_first_engine && !known.emplace(scene_key(run), run.role).second) continue;
    if (!is_first_engine && !candidates[run.simulator].empty()) continue;
    candidates[run.simulator].push_back(i);
  }
  for (const std::string& engine : experiment.simulators) {
    simulate(experiment, plan, spread(candidates[engine], most_scenes), engine, should_continue,
             sample);
  }
  double simulated = 0.0;
  double planned = 0.0;
  for (const auto& [index, run] : sample.runs) {
    sample.duration[scene_key(run.plan)] = run.report.duration;
    simulated += run.report.duration;
    planned += run.plan.scenario.end.duration;
  }
  if (planned > 0.0) sample.share = simulated / planned;
  return sample;
}

double duration_of(const PlannedRun& run, const Sample& sample) {
  const auto found = sample.duration.find(scene_key(run));
  return found == sample.duration.end() ? sample.share * run.scenario.end.duration : found->second;
}

double steps_of(const PlannedRun& run, const Sample& sample) {
  return duration_of(run, sample) * steps_per_second(run);
}

/// Runs that differ only in their sensors share a simulation. Those of every fit are simulated for
/// themselves.
double simulation_cost(const Plan& plan, const Sample& sample) {
  std::set<std::tuple<std::string, std::string, std::int64_t, std::uint64_t, int, std::string>>
      simulations;
  double seconds = 0.0;
  for (const PlannedRun& run : plan.runs) {
    const bool is_new = simulations
                            .emplace(run.scenario.name + run.scenario.robot.string(), run.simulator,
                                     run.run, run.seed, static_cast<int>(run.role), run.fit)
                            .second;
    const auto rate = sample.step_seconds.find(run.simulator);
    if (is_new && rate != sample.step_seconds.end())
      seconds += rate->second * steps_of(run, sample);
  }
  return seconds;
}

/// Training data of one fit on one engine (s): whole runs and segments.
double training_seconds(const Experiment& experiment, const Plan& plan, const std::string& fit,
                        const Sample& sample) {
  double seconds = 0.0;
  for (const PlannedRun& run : plan.runs) {
    if (run.role != RunRole::fit || run.fit != fit) continue;
    if (run.simulator != experiment.simulators.front()) continue;
    double used = duration_of(run, sample);
    if (run.group > 0) {
      used = std::min(used, experiment.training_segments[run.group - segment_group(0)].length);
    }
    seconds += used;
  }
  return seconds;
}

/// Whether tuning has trials of this estimator.
bool is_tried(const std::string& estimator, const Experiment& experiment) {
  const EstimatorEntry& entry = estimator_entry(experiment, estimator);
  const std::vector<std::string>& fixed = experiment.tuning->fixed;
  return !entry.is_upper_bound && !entry.hyperparameters.empty() &&
         std::find(fixed.begin(), fixed.end(), estimator) == fixed.end();
}

/// An evaluation: estimators are made once in a run, then updated step by step (s).
struct RunCost {
  double fixed = 0.0;
  double per_step = 0.0;
};

/// The evaluation of a run in all conditions of a group, without refits.
struct EvaluationCost {
  RunCost counted;
  RunCost scored;
  RunCost tried;  ///< the part of `scored` that is of estimators with trials
};

EvaluationCost sample_evaluation(const RunRequest& request, const Plan& plan, const FitSample& fits,
                                 const Sample& sample, const ShouldContinue& should_continue) {
  EvaluationCost cost;
  const Experiment& experiment = request.experiment;
  const std::string& engine = experiment.simulators.front();
  const auto found = std::find_if(sample.runs.begin(), sample.runs.end(), [&](const auto& entry) {
    const Rollout& run = entry.second;
    return run.plan.role == RunRole::test && run.plan.group == 0 && run.plan.simulator == engine &&
           !run.failed();
  });
  if (found == sample.runs.end()) return cost;
  const RunSignals longer = beginning_of(found->second.signals, evaluated_seconds);
  const RunSignals shorter = beginning_of(found->second.signals, 0.25 * evaluated_seconds);
  const auto is_unfitted = [&](const Condition& condition) {
    const bool needs_fit = std::find(experiment.estimators.begin(), experiment.estimators.end(),
                                     condition.estimator) != experiment.estimators.end() &&
                           estimator_entry(experiment, condition.estimator).fits();
    const auto models = fits.models.find(engine);
    return needs_fit &&
           (models == fits.models.end() || !models->second.contains(condition.estimator));
  };
  Plan small = plan;
  RunGroup& group = small.groups.front();
  std::erase_if(group.conditions, [&](const Condition& condition) {
    return !condition.is_fitted_in_domain() || is_unfitted(condition);
  });
  const Task task = {found->first, 0, noise_key(experiment, 0, found->second.plan.run)};
  const auto seconds_of = [&](const RunSignals& run) {
    return cost_of(
        [&] { (void)evaluate(small, task, run, experiment, fits.models, should_continue); });
  };
  const auto measured = [&] {
    (void)seconds_of(shorter);  // what is read from disk is read before
    const double first = seconds_of(shorter);
    const double all = seconds_of(longer);
    const auto steps = static_cast<double>(std::max(longer.steps(), shorter.steps() + 1));
    const auto first_steps = static_cast<double>(shorter.steps());
    const double per_step = std::max(0.0, (all - first) / (steps - first_steps));
    return RunCost{std::max(0.0, first - first_steps * per_step), per_step};
  };
  const RunCost all = measured();
  group.counted.clear();
  cost.scored = measured();
  cost.counted = {std::max(0.0, all.fixed - cost.scored.fixed),
                  std::max(0.0, all.per_step - cost.scored.per_step)};
  if (!experiment.tuning) return cost;
  std::erase_if(group.conditions, [&](const Condition& condition) {
    return !is_tried(condition.estimator, experiment);
  });
  cost.tried = measured();
  return cost;
}

/// The evaluation of all tasks.
double evaluation_cost(const Plan& plan, const EvaluationCost& cost, const Sample& sample) {
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
    const double steps = steps_of(run, sample);
    seconds += (cost.scored.fixed + steps * cost.scored.per_step * cells) * predicted / of_own +
               (cost.counted.fixed + steps * cost.counted.per_step) * counted_cells;
  }
  return seconds;
}

/// The trials of one fit: every fold fits and evaluates all trials.
double tuning_cost(const RunRequest& request, const Plan& plan, const std::string& fit,
                   const FitSample& fits, const EvaluationCost& cost, const Sample& sample) {
  const Experiment& experiment = request.experiment;
  if (!experiment.tuning || !(fit.empty() || experiment.tuning->everywhere)) return 0.0;
  const TuningConfig& tuning = *experiment.tuning;
  const double fitted =
      training_seconds(experiment, plan, fit, sample) * (tuning.folds - 1.0) / tuning.folds;
  double fits_of_trials = 0.0;
  for (const FitCost& one : fits.costs) {
    if (!is_tried(one.estimator, experiment)) continue;
    fits_of_trials += tuning.folds * (one.is_tuned ? tuning.trials : 1.0) * one.of(fitted);
  }
  double held_out = 0.0;  // steps
  double runs = 0.0;
  for (const PlannedRun& run : plan.runs) {
    if (run.role == RunRole::fit && run.fit == fit && run.group == 0 &&
        run.simulator == experiment.simulators.front()) {
      held_out += steps_of(run, sample);
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
double memory_of(const Experiment& experiment, const Plan& plan, const Sample& sample,
                 const FitSample& fits, double at_start) {
  double held = 0.0;
  double longest = 0.0;  // steps
  std::map<std::pair<std::string, std::string>, double> of_fit;
  for (const PlannedRun& run : plan.runs) {
    double steps = steps_of(run, sample);
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
  return at_start + held + std::max(runs, largest + std::max(runs, fits.memory(threads)));
}

}  // namespace

double CostEstimate::seconds() const {
  double sum = 0.0;
  for (const StageCost& stage : stages) sum += std::isnan(stage.seconds) ? 0.0 : stage.seconds;
  return sum;
}

CostEstimate estimate_cost(const RunRequest& request, const Plan& plan,
                           const std::function<bool()>& should_continue) {
  const auto start = std::chrono::steady_clock::now();
  const Experiment& experiment = request.experiment;
  const double at_start = memory_in_use();
  CostEstimate estimate;
  const Sample sample = sampled(experiment, plan, should_continue);
  const FitSample fits = sample_fits(experiment, sample.runs, should_continue);
  const EvaluationCost cost = sample_evaluation(request, plan, fits, sample, should_continue);

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
    const double seconds = training_seconds(experiment, plan, name, sample);
    fit += engines * (fits.of(seconds) + repeated * fits.of_refit(seconds));
    tune += tuning_cost(request, plan, name, fits, cost, sample);
  }
  estimate.stages.push_back({"simulate", simulation_cost(plan, sample)});
  if (experiment.tuning) estimate.stages.push_back({"tune", tune});
  estimate.stages.push_back({"fit", fit});
  estimate.stages.push_back({"evaluate", evaluation_cost(plan, cost, sample)});
  if (!plan.model_tasks.empty()) {
    estimate.stages.push_back({"model_tasks", std::numeric_limits<double>::quiet_NaN()});
  }
  estimate.step_seconds = sample.step_seconds;
  estimate.memory = memory_of(experiment, plan, sample, fits, at_start);
  estimate.disk = disk_needs(plan).all();
  estimate.measured =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return estimate;
}

}  // namespace touchdown::experiments
