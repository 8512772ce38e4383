#pragma once

#include "experiments/plan/request.hpp"

namespace touchdown::experiments {

/// The size of an experiment. It is known before the plan, which may be too large itself.
struct Needs {
  double runs = 0.0;
  double parts = 0.0;    ///< of the evaluation
  double seconds = 0.0;  ///< least duration of all runs together, if none fails
  double steps = 0.0;    ///< control steps of these runs
  double setups = 1.0;   ///< robots and sensors of the test runs, the experiment's own included
  bool motion = false;   ///< whether test runs keep their motion
};

/// Adds runs of a scenario. Each is evaluated with `seeds` noise seeds, and its signals are kept
/// once for each of `sensors` sensor models.
void add_runs(Needs& needs, const scenarios::Scenario& scenario, double runs, double seeds,
              double sensors = 1.0);

}  // namespace touchdown::experiments
