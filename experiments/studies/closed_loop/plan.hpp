#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "experiments/plan/plan.hpp"
#include "experiments/studies/closed_loop/config.hpp"

namespace touchdown::experiments {

/// One point of one survival curve. Its runs differ only in their random draws.
struct ClosedLoopCell {
  std::string simulator;
  std::string law;
  std::string contact;    ///< source of the policy: `truth`, `always`, an estimator
  std::size_t scene = 0;  ///< index in the section
  std::size_t point = 0;  ///< index in the scene
  double value = 0.0;     ///< of the scene's key; NaN without a key
  noise::NoiseCell noise = {};
  double delay = 0.0;  ///< of the contact (s)

  /// Oracles read the simulator's state: no robot has them, and nothing is ever fitted to their
  /// runs.
  bool is_oracle() const { return contact == "truth"; }
};

/// The cells of the section `closed_loop`, by scene, engine, law, contact source, then point. Empty
/// without the section.
std::vector<ClosedLoopCell> closed_loop_cells(const Experiment& experiment);

/// The number of runs of all cells. Runs are numbered from 0; those of a cell are consecutive.
std::size_t closed_loop_runs(const Experiment& experiment);

/// The scenario of a cell, without perturbations. Errors: `InputError` that names the scene and the
/// invalid value.
scenarios::Scenario scenario_of(const RunRequest& request, const ClosedLoopCell& cell);

/// Checks all cells. Errors: as above; `InputError` for scenes with another control period than the
/// test runs, and for contact sources that need whole runs.
void require_closed_loop(const RunRequest& request);

/// What a scene varies, for tables and axes: "", the last part of a key as "rise", "delay",
/// "noise".
std::string varied_quantity(const ClosedLoopScene& scene);

}  // namespace touchdown::experiments
