#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/interval.hpp"
#include "experiments/run_directory/directory.hpp"
#include "experiments/studies/closed_loop/metrics.hpp"
#include "experiments/studies/closed_loop/rollout.hpp"

namespace touchdown::experiments {

/// One point of a survival curve.
struct SurvivalRow {
  ClosedLoopCell cell;
  std::string scene;               ///< the scenario's name
  std::string robot;               ///< its file's stem
  std::string sensors;             ///< likewise; "ideal"
  std::string varied;              ///< `varied_quantity`
  std::string key;                 ///< of the scenario, with the cell's value; empty: none
  ClosedLoopMetrics metrics = {};  ///< of all runs
  Interval finished = {};          ///< share, with its exact interval
  /// Runs that finish here but not with the contact source `always`, at the same law, start and
  /// perturbations; and the reverse. Both 0 if `always` is not in the experiment.
  int won_against_always = 0;
  int lost_against_always = 0;
};

/// Rows in the order of the cells; `saved` returns the metrics of a run by its number. Errors:
/// `Error` for a run that is not saved.
std::vector<SurvivalRow> survival_rows(
    const RunRequest& request,
    const std::function<std::optional<ClosedLoopMetrics>(std::size_t run)>& saved);

/// Writes `survival.csv`.
void write_tables(const std::vector<SurvivalRow>& rows, const RunDirectory& directory);

/// A summary for the terminal.
std::string survival_text(const std::vector<SurvivalRow>& rows, const Experiment& experiment);

}  // namespace touchdown::experiments
