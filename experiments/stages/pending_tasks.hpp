#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "experiments/plan/plan.hpp"

namespace touchdown::experiments {

/// The tasks that are not evaluated yet, and the fits that they need. Fits are made one after the
/// other. Tasks can be evaluated as soon as their fits are there; tasks that share a simulation
/// only together, or it would run twice.
class PendingTasks {
 public:
  PendingTasks(const Plan& plan, const TaskRange& tasks);

  /// Removes and returns the tasks with all their fits among `models`, as indices in the plan.
  std::vector<std::size_t> take_ready(const FittedModels& models);
  /// Removes and returns all tasks that are left.
  std::vector<std::size_t> take_all();

  /// Whether a task that is left needs the fit with this key.
  [[nodiscard]] bool needs(const std::string& model_key) const;

 private:
  struct Simulation {
    std::vector<std::size_t> tasks;
    std::set<std::string> fits;  ///< keys
  };
  std::vector<Simulation> simulations_;
};

}  // namespace touchdown::experiments
