#include "experiments/calibration.hpp"

#include <algorithm>
#include <chrono>
#include <mutex>
#include <set>
#include <utility>

#include "core/error.hpp"
#include "core/files.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/evaluation/tasks.hpp"
#include "experiments/processor_time.hpp"
#include "experiments/rollouts/rollouts.hpp"
#include "experiments/stages/experiment_context.hpp"
#include "experiments/stages/process_memory.hpp"

namespace touchdown::experiments {

namespace {

/// Limits of the calibration.
constexpr std::size_t most_scenes = 16;    // simulated on the first engine, without fitted ones
constexpr double evaluated_seconds = 2.0;  // of one run, and a quarter of them

/// At most `most` of the indices, evenly spread.
std::set<std::size_t> spread(const std::vector<std::size_t>& all, std::size_t most) {
  std::set<std::size_t> chosen;
  const std::size_t count = std::min(most, all.size());
  for (std::size_t i = 0; i < count; ++i) chosen.insert(all[i * all.size() / count]);
  return chosen;
}

void simulate(const Experiment& experiment, const Plan& plan, const std::set<std::size_t>& chosen,
              const std::string& engine, const ShouldContinue& should_continue, Rollouts& runs,
              Calibration& found) {
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
                       runs.insert_or_assign(index, std::move(run));
                     });
  });
  if (steps > 0.0) found.step_seconds[engine] = cost / steps;
}

/// Simulates one run of every scene on the first engine, or of some if there are many, and one on
/// every other engine. Runs of the experiment's own fit are always among them.
Rollouts sample_runs(const Experiment& experiment, const Plan& plan,
                     const ShouldContinue& should_continue, Calibration& found) {
  Rollouts runs;
  std::vector<std::size_t> fitted;
  std::map<std::string, std::vector<std::size_t>> candidates;
  std::set<std::pair<SceneKey, RunRole>> known;
  for (std::size_t i = 0; i < plan.runs.size(); ++i) {
    const PlannedRun& run = plan.runs[i];
    const bool is_first_engine = run.simulator == experiment.simulators.front();
    if (is_first_engine && !known.emplace(scene_key(run), run.role).second) continue;
    if (!is_first_engine && !candidates[run.simulator].empty()) continue;
    const bool is_fitted = is_first_engine && run.role == RunRole::fit && run.fit.empty();
    (is_fitted ? fitted : candidates[run.simulator]).push_back(i);
  }
  for (const std::string& engine : experiment.simulators) {
    std::set<std::size_t> chosen = spread(candidates[engine], most_scenes);
    if (engine == experiment.simulators.front()) chosen.merge(spread(fitted, most_fitted_runs));
    simulate(experiment, plan, chosen, engine, should_continue, runs, found);
  }
  double simulated = 0.0;
  double planned = 0.0;
  for (const auto& [index, run] : runs) {
    found.duration[scene_key(run.plan)] = run.report.duration;
    simulated += run.report.duration;
    planned += run.plan.scenario.end.duration;
  }
  if (planned > 0.0) found.share = simulated / planned;
  return runs;
}

EvaluationCost sample_evaluation(const RunRequest& request, const Plan& plan, const FitSample& fits,
                                 const Rollouts& runs, const ShouldContinue& should_continue) {
  EvaluationCost cost;
  const Experiment& experiment = request.experiment;
  const std::string& engine = experiment.simulators.front();
  const auto found = std::find_if(runs.begin(), runs.end(), [&](const auto& entry) {
    const Rollout& run = entry.second;
    return run.plan.role == RunRole::test && run.plan.group == 0 && run.plan.simulator == engine &&
           !run.failed();
  });
  if (found == runs.end()) return cost;
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
    return cost_of([&] {
      NoiseFreeScores none;
      (void)evaluate(small, task, run, experiment, fits.models, none, should_continue);
    });
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

}  // namespace

SceneKey scene_key(const PlannedRun& run) {
  return {run.scenario.name, run.scenario.robot.string()};
}

double steps_per_second(const PlannedRun& run) {
  return 1e6 / static_cast<double>(run.scenario.simulation.steps.control_us);
}

bool is_tried(const std::string& estimator, const Experiment& experiment) {
  const EstimatorEntry& entry = estimator_entry(experiment, estimator);
  const std::vector<std::string>& fixed = experiment.tuning->fixed;
  return !entry.is_upper_bound && !entry.hyperparameters.empty() &&
         std::find(fixed.begin(), fixed.end(), estimator) == fixed.end();
}

Calibration calibrate(const RunRequest& request, const Plan& plan,
                      const ShouldContinue& should_continue) {
  const auto start = std::chrono::steady_clock::now();
  Calibration found;
  found.memory_in_use = memory_in_use();
  const Rollouts runs = sample_runs(request.experiment, plan, should_continue, found);
  found.fits = sample_fits(request.experiment, runs, should_continue);
  found.evaluation = sample_evaluation(request, plan, found.fits, runs, should_continue);
  found.measured = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return found;
}

}  // namespace touchdown::experiments
