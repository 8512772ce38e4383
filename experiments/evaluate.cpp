#include <algorithm>
#include <atomic>
#include <map>

#include "core/error.hpp"
#include "core/program.hpp"
#include "experiments/results/result_files.hpp"
#include "experiments/stages.hpp"

namespace touchdown::experiments {

namespace {

/// Simulates the streamed test runs of these tasks, and evaluates each at once. Returns the number
/// of tasks that were not saved.
std::size_t evaluate_streamed(const ExperimentContext& context,
                              const std::vector<std::size_t>& tasks, Computed& done) {
  const Plan& plan = context.plan;
  const Experiment& experiment = context.request.experiment;
  std::map<std::size_t, std::vector<const Task*>> tasks_of;
  std::set<std::size_t> tests;
  for (const std::size_t t : tasks) {
    const std::size_t index = plan.tasks[t].run;
    if (!done.streamed.contains(index)) continue;
    tasks_of[index].push_back(&plan.tasks[t]);
    tests.insert(index);
    done.runs.emplace(index, Rollout{plan.runs[index], {}, {}});
  }
  std::atomic<std::size_t> computed = 0;
  if (tests.empty()) return computed;
  for_each_rollout(experiment, plan, tests, context.directory, done.missing,
                   context.should_continue, [&](std::size_t index, Rollout run) {
                     NoiseFreeScores noise_free;
                     for (const Task* task : tasks_of.at(index)) {
                       const bool is_new = evaluate_and_save(plan, *task, run, experiment,
                                                             done.models, context.directory.store(),
                                                             noise_free, context.should_continue);
                       if (is_new) ++computed;
                     }
                     drop_signals(run);
                     done.runs.at(index) = std::move(run);
                     release_free_memory();  // the pieces of ever new sizes that runs leave
                   });
  return computed;
}

/// Evaluates these tasks unless they are saved.
void evaluate_tasks(const ExperimentContext& context, const std::vector<std::size_t>& tasks,
                    Computed& done) {
  done.tasks += evaluate(context.plan, tasks, done.runs, context.request.experiment, done.models,
                         context.directory.store(), context.should_continue);
  done.tasks += evaluate_streamed(context, tasks, done);
}

}  // namespace

void evaluate_ready(ExperimentContext& context, Computed& done) {
  if (done.streamed.empty()) return;
  const StageTimer timer(context, "evaluate");
  evaluate_tasks(context, done.pending.take_ready(done.models), done);
  release_free_memory();
}

void evaluate_rest(ExperimentContext& context, Computed& done) {
  if (!context.should_continue()) throw Stopped();
  const StageTimer timer(context, "evaluate");
  evaluate_tasks(context, done.pending.take_all(), done);
}

void run_model_tasks(ExperimentContext& context, const Computed& done) {
  if (!has_model_tasks(context.plan, done.share)) return;
  const StageTimer timer(context, "model_tasks");
  run_model_tasks(context.plan, done.share, done.models, context.directory.store(), done.missing,
                  context.should_continue);
}

PendingTasks::PendingTasks(const Plan& plan, const TaskRange& tasks) {
  std::map<std::size_t, std::size_t> of_run;  // index in `simulations_`
  std::map<std::string, std::size_t> of_key;
  for (std::size_t t = tasks.begin; t < tasks.end; ++t) {
    const std::size_t index = plan.tasks[t].run;
    const PlannedRun& run = plan.runs[index];
    if (!of_run.contains(index)) {
      of_run[index] = of_key.emplace(simulation_key(run), of_key.size()).first->second;
      simulations_.resize(of_key.size());
    }
    Simulation& simulation = simulations_[of_run.at(index)];
    simulation.tasks.push_back(t);
    for (const Condition& condition : plan.groups[run.group].conditions) {
      if (condition.test_simulator != run.simulator) continue;
      simulation.fits.insert(model_key(condition.fit_simulator, condition.fit, condition.refit));
    }
  }
}

std::vector<std::size_t> PendingTasks::take_ready(const FittedModels& models) {
  std::vector<std::size_t> ready;
  std::erase_if(simulations_, [&](const Simulation& simulation) {
    const bool is_ready = std::all_of(simulation.fits.begin(), simulation.fits.end(),
                                      [&](const std::string& fit) { return models.contains(fit); });
    if (is_ready) ready.insert(ready.end(), simulation.tasks.begin(), simulation.tasks.end());
    return is_ready;
  });
  return ready;
}

std::vector<std::size_t> PendingTasks::take_all() {
  std::vector<std::size_t> all;
  for (const Simulation& simulation : simulations_) {
    all.insert(all.end(), simulation.tasks.begin(), simulation.tasks.end());
  }
  simulations_.clear();
  return all;
}

bool PendingTasks::needs(const std::string& model_key) const {
  return std::any_of(simulations_.begin(), simulations_.end(), [&](const Simulation& simulation) {
    return simulation.fits.contains(model_key);
  });
}

}  // namespace touchdown::experiments
