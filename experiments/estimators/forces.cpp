#include "estimator/force/load_filter.hpp"
#include "experiments/estimators/entries.hpp"

namespace touchdown::experiments {

std::vector<EstimatorEntry> force_entries() {
  const LoadFilterConfig usual;
  return {
      {.name = "load_filter",
       .title = "Load filter",
       .summary = "Filters each wheel's load, by its leg's equations of motion, with two states",
       .reason = "data: no labels; any robot, by its file alone",
       .sensors = all_sensors,
       .knows = {.geometry = true, .mass = true, .targets = true},
       .hyperparameters = {between("lead", usual.lead, 0.0, 0.02),
                           between("leave_below", usual.leave_below, 0.005, 0.4),
                           between("return_above", usual.return_above, 0.5, 0.995)},
       .making = {.by_step = make_of_model}}};
}

}  // namespace touchdown::experiments
