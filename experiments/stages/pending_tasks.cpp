#include "experiments/stages/pending_tasks.hpp"

#include <algorithm>
#include <map>

#include "experiments/rollouts/rollouts.hpp"

namespace touchdown::experiments {

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
