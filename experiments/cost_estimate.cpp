#include "experiments/cost_estimate.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <limits>
#include <mutex>
#include <set>
#include <tuple>
#include <utility>

#include "core/error.hpp"
#include "core/files.hpp"
#include "experiments/config/experiment_estimators.hpp"
#include "experiments/evaluation/tasks.hpp"
#include "experiments/fitting/fitting.hpp"
#include "experiments/needs.hpp"
#include "experiments/rollouts/rollouts.hpp"

namespace touchdown::experiments {

namespace {

/// Limits of the calibration.
constexpr std::size_t most_scenes = 16;      // simulated on the first engine
constexpr std::size_t most_fitted_runs = 6;  // in the fits
constexpr double fitted_seconds = 3.0;       // of each
constexpr double evaluated_seconds = 1.5;    // of one run

/// Processor time of this process (s).
double processor_seconds() {
  timespec now = {};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Processor time that `action` takes (s).
template <typename Action>
double cost_of(const Action& action) {
  const double start = processor_seconds();
  action();
  return processor_seconds() - start;
}

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

/// Runs that differ only in their sensors share a simulation, unless they are streamed.
double simulation_cost(const Plan& plan, const Sample& sample) {
  std::set<std::tuple<std::string, std::string, std::int64_t, std::uint64_t, int, std::size_t>>
      simulations;
  double seconds = 0.0;
  for (const PlannedRun& run : plan.runs) {
    const std::size_t group = run.role == RunRole::fit ? run.group : 0;
    const bool is_new = simulations
                            .emplace(run.scenario.name + run.scenario.robot.string(), run.simulator,
                                     run.run, run.seed, static_cast<int>(run.role), group)
                            .second;
    const auto rate = sample.step_seconds.find(run.simulator);
    if (is_new && rate != sample.step_seconds.end())
      seconds += rate->second * steps_of(run, sample);
  }
  return seconds;
}

/// The first `seconds` of a run.
RunSignals beginning_of(const RunSignals& run, double seconds) {
  RunSignals part = run;
  const auto steps = static_cast<std::size_t>(
      std::llround(1e6 * seconds / static_cast<double>(run.info.control_period_us)));
  if (steps >= run.steps()) return part;
  part.signals.resize(steps);
  part.up_in_imu.resize(steps);
  for (std::size_t w = 0; w < models::wheel_count; ++w) {
    part.contact[w].resize(steps);
    part.normal_force[w].resize(steps);
  }
  std::erase_if(part.segments, [&](std::size_t first) { return first >= steps; });
  part.motion.reset();
  return part;
}

/// Fits of the calibration: cost per second of training data.
struct FitSample {
  FittedModels models;            ///< of the first engine
  double fixed_per_second = 0.0;  ///< of fits that no hyperparameter of a trial changes
  double trial_per_second = 0.0;  ///< of fits that differ from trial to trial
  double per_second() const { return fixed_per_second + trial_per_second; }
};

FitSample fitted(const Experiment& experiment, const Sample& sample,
                 const ShouldContinue& should_continue) {
  FitSample found;
  const std::string& engine = experiment.simulators.front();
  std::vector<RunSignals> runs;
  double seconds = 0.0;
  for (const auto& [index, run] : sample.runs) {
    const bool is_wanted = run.plan.role == RunRole::fit && run.plan.simulator == engine &&
                           run.plan.fit.empty() && !run.failed() && runs.size() < most_fitted_runs;
    if (!is_wanted) continue;
    runs.push_back(beginning_of(run.signals, fitted_seconds));
    seconds += static_cast<double>(runs.back().steps()) * 1e-6 *
               static_cast<double>(runs.back().info.control_period_us);
  }
  if (runs.empty()) return found;
  std::vector<const RunSignals*> whole;
  for (const RunSignals& run : runs) whole.push_back(&run);
  const FitRuns data{whole,
                     {},
                     experiment.scoring,
                     [&] {
                       if (!should_continue()) throw Stopped();
                     },
                     experiment.fit_servo_load};
  for (const std::string& name : experiment.estimators) {
    const EstimatorEntry& entry = estimator_entry(experiment, name);
    if (!entry.fits()) continue;
    FittedModel& model = found.models[engine][name];
    const auto same = std::find_if(
        found.models[engine].begin(), found.models[engine].end(), [&](const auto& other) {
          return other.first != name &&
                 share_model(entry, estimator_entry(experiment, other.first));
        });
    if (same != found.models[engine].end()) {
      model = same->second;
      model.metadata = new_metadata(name, data, {});
      continue;
    }
    try {
      const double cost = cost_of([&] { model = fit_model(entry, data); });
      model.metadata = new_metadata(name, data, {});
      const bool differs = std::any_of(
          entry.hyperparameters.begin(), entry.hyperparameters.end(),
          [](const Hyperparameter& hyperparameter) { return hyperparameter.is_fitted_with; });
      (differs ? found.trial_per_second : found.fixed_per_second) += cost / seconds;
    } catch (const InputError&) {
      found.models[engine].erase(name);  // the beginnings of the runs do not suffice for it
    }
  }
  return found;
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

/// The evaluation of one step of a run in all conditions of a group, without refits.
struct StepCost {
  double counted = 0.0;
  double scored = 0.0;
};

StepCost step_cost(const RunRequest& request, const Plan& plan, const FitSample& fits,
                   const Sample& sample, const ShouldContinue& should_continue) {
  StepCost cost;
  const Experiment& experiment = request.experiment;
  const std::string& engine = experiment.simulators.front();
  const auto found = std::find_if(sample.runs.begin(), sample.runs.end(), [&](const auto& entry) {
    const Rollout& run = entry.second;
    return run.plan.role == RunRole::test && run.plan.group == 0 && run.plan.simulator == engine &&
           !run.failed();
  });
  if (found == sample.runs.end()) return cost;
  const RunSignals run = beginning_of(found->second.signals, evaluated_seconds);
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
  const auto measured = [&] {
    return cost_of([&] {
             (void)evaluate(small, task, run, experiment, fits.models, should_continue);
           }) /
           static_cast<double>(run.steps());
  };
  const double all = measured();
  group.counted.clear();
  cost.scored = measured();
  cost.counted = std::max(0.0, all - cost.scored);
  return cost;
}

/// The evaluation of all tasks.
double evaluation_cost(const Plan& plan, const StepCost& step, const Sample& sample) {
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
    seconds += steps_of(run, sample) *
               (step.scored * cells * predicted / of_own + step.counted * counted_cells);
  }
  return seconds;
}

/// The trials of one fit: every fold fits and evaluates all trials.
double tuning_cost(const RunRequest& request, const Plan& plan, const std::string& fit,
                   const FitSample& fits, const StepCost& step, const Sample& sample) {
  const Experiment& experiment = request.experiment;
  if (!experiment.tuning || !(fit.empty() || experiment.tuning->everywhere)) return 0.0;
  const TuningConfig& tuning = *experiment.tuning;
  const double fitted = training_seconds(experiment, plan, fit, sample) * (tuning.folds - 1.0);
  const double fits_of_trials =
      fitted * (fits.fixed_per_second + tuning.trials * fits.trial_per_second);
  double held_out = 0.0;  // steps
  for (const PlannedRun& run : plan.runs) {
    if (run.role == RunRole::fit && run.fit == fit && run.group == 0 &&
        run.simulator == experiment.simulators.front()) {
      held_out += steps_of(run, sample);
    }
  }
  const auto cells =
      static_cast<double>(std::max<std::size_t>(1, plan.groups.front().scored.size()));
  const double evaluated =
      held_out * tuning.trials * step.scored * static_cast<double>(tuning.noise.size()) / cells;
  return static_cast<double>(experiment.simulators.size()) * (fits_of_trials + evaluated);
}

/// Signals that are in memory at once: those of test runs that are held, and of the largest fit.
double memory_of(const Plan& plan, const Sample& sample) {
  double held = 0.0;
  std::map<std::string, double> of_fit;
  for (const PlannedRun& run : plan.runs) {
    const double bytes = steps_of(run, sample) * signal_bytes_per_step(plan.needs_motion);
    const bool is_of_a_fit = run.role == RunRole::fit && plan.kept_signals != KeptSignals::all;
    if (is_of_a_fit) {
      of_fit[run.fit] += bytes;
    } else if (!is_streamed(run, plan)) {
      held += bytes;
    }
  }
  double largest = 0.0;
  for (const auto& [fit, bytes] : of_fit) largest = std::max(largest, bytes);
  return held + largest;
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
  CostEstimate estimate;
  const Sample sample = sampled(experiment, plan, should_continue);
  const FitSample fits = fitted(experiment, sample, should_continue);
  const StepCost step = step_cost(request, plan, fits, sample, should_continue);

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
    fit += engines * (1.0 + repeated) * fits.per_second() *
           training_seconds(experiment, plan, name, sample);
    tune += tuning_cost(request, plan, name, fits, step, sample);
  }
  estimate.stages.push_back({"simulate", simulation_cost(plan, sample)});
  if (experiment.tuning) estimate.stages.push_back({"tune", tune});
  estimate.stages.push_back({"fit", fit});
  estimate.stages.push_back({"evaluate", evaluation_cost(plan, step, sample)});
  if (!plan.model_tasks.empty()) {
    estimate.stages.push_back({"model_tasks", std::numeric_limits<double>::quiet_NaN()});
  }
  estimate.step_seconds = sample.step_seconds;
  estimate.memory = memory_of(plan, sample);
  estimate.disk = disk_needs(plan).all();
  estimate.measured =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return estimate;
}

}  // namespace touchdown::experiments
