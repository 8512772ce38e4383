#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "experiments/plan/plan.hpp"

namespace touchdown::experiments {

/// One point of one survival curve: runs that differ in what is drawn for them alone.
struct ClosedLoopCell {
  std::string simulator;
  std::string law;
  std::string contact;    ///< who tells the law: `truth`, `always`, an estimator
  std::size_t scene = 0;  ///< of the section's
  std::size_t point = 0;  ///< of the scene's
  double value = 0.0;     ///< of the scene's key; NaN without one
  noise::NoiseCell noise = {};
  double delay = 0.0;  ///< s

  /// Oracles look at the simulator: no robot has them, and nothing is ever fitted to their runs.
  bool is_oracle() const { return contact == "truth"; }
};

/// What the section `closed_loop` asks for: scene by scene, engine by engine, law by law, teller by
/// teller, point by point. Nothing without the section.
std::vector<ClosedLoopCell> closed_loop_cells(const Experiment& experiment);

/// Its runs, numbered from 0: every cell's in a row.
std::size_t closed_loop_runs(const Experiment& experiment);

/// The share of these runs that belongs to a share of the plan's tasks.
TaskRange closed_loop_runs_of(const Experiment& experiment, const TaskRange& tasks, std::size_t all_tasks);

/// The scenario of a cell as it stands. Errors: `InputError` naming the scene and the value that
/// the scenario refuses.
scenarios::Scenario scenario_of(const RunRequest& request, const ClosedLoopCell& cell);

/// Errors: as above, for any cell; for scenes that are played at another rate than the test runs,
/// and for tellers that hear whole runs only.
void require_closed_loop(const RunRequest& request);

/// What a scene varies, for tables and axes: "", the last part of a key as "rise", "late", "noise".
std::string varied_quantity(const ClosedLoopScene& scene);

}  // namespace touchdown::experiments
