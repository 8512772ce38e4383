#pragma once

#include <string>
#include <vector>

#include "core/interval.hpp"
#include "experiments/studies/closed_loop/metrics.hpp"
#include "experiments/studies/closed_loop/rollout.hpp"
#include "experiments/run_directory/directory.hpp"

namespace touchdown::experiments {

/// One point of a survival curve.
struct SurvivalRow {
  ClosedLoopCell cell;
  std::string scene;         ///< the scenario's name
  std::string robot;         ///< its file's stem
  std::string sensors;       ///< likewise; "ideal"
  std::string varied;        ///< `varied_quantity`
  std::string key;           ///< of the scenario, that has the cell's value; empty: none
  ClosedLoopMetrics outcome = {};  ///< of all runs
  Interval finished = {};    ///< share, with its exact interval
  /// Runs that this one finished and the same law told `always` did not, started alike; and the
  /// other way round. Both 0 where nobody is told always.
  int won_against_always = 0;
  int lost_against_always = 0;
};

/// In the order of the cells. Errors: `Error` for a run that nobody saved.
std::vector<SurvivalRow> survival_rows(const RunRequest& request, const SavedClosedLoops& saved);

/// `survival.csv`.
void write_tables(const std::vector<SurvivalRow>& rows, const RunDirectory& directory);

/// The same in short, for people.
std::string survival_text(const std::vector<SurvivalRow>& rows, const Experiment& experiment);

}  // namespace touchdown::experiments
